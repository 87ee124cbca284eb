#include "client/view/recent_file.h"

#include "client/view/state_folder.h"
#include "common/base/text_file.h"

namespace shearwater::ui {

namespace {

constexpr std::size_t most_recent_bytes = std::size_t{1} << 20;

std::optional<std::filesystem::path> file() {
    const auto folder = state_folder();
    return folder ? std::optional(*folder / "recent.toml") : std::nullopt;
}

// No file: an empty list, and nothing wrong.
RecentFile::Outcome read(const std::filesystem::path& path) {
    std::error_code none;
    if (std::filesystem::symlink_status(path, none).type() == std::filesystem::file_type::not_found) {
        return {};
    }
    const auto text = base::read_text_file(path.string(), most_recent_bytes);
    auto list = text ? model::recent_from_toml(*text, path.string()) : text.error();
    if (!list) {
        return {{}, "Recent connections are passed over: " + list.error().message()};
    }
    return {*std::move(list), ""};
}

}  // namespace

RecentFile::RecentFile(std::function<void()> wake) : errands_(std::move(wake)) {
    errands_.ask([] {
        const auto path = file();
        return std::optional(path ? read(*path) : Outcome());
    });
}

void RecentFile::add(const model::Recent& recent) {
    change([recent](model::RecentList& list) { list.add(recent); });
}

void RecentFile::remove(const std::string& name) {
    change([name](model::RecentList& list) { list.remove(name); });
}

// A file that is none is written anew.
void RecentFile::change(std::function<void(model::RecentList&)> change) {
    errands_.ask([change = std::move(change)]() -> std::optional<Outcome> {
        const auto path = file();
        if (!path) {
            return std::nullopt;
        }
        Outcome outcome = read(*path);
        outcome.fault.clear();
        change(outcome.list);
        if (const auto written = base::write_text_file(path->string(), to_toml(outcome.list)); !written) {
            outcome.fault = "Recent connections are not kept: " + written.error().message();
        }
        return outcome;
    });
}

}  // namespace shearwater::ui
