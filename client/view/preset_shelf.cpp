#include "client/view/preset_shelf.h"

#include <utility>

namespace shearwater::ui {

namespace {

PresetShelf::Outcome outcome_of(const base::Status& status, std::string name, std::string done) {
    return {.names = {},
            .name = std::move(name),
            .loaded = {},
            .message = status ? std::move(done) : status.error().message(),
            .is_fault = !status};
}

}  // namespace

void PresetShelf::list() {
    ask([] { return Outcome{}; });
}

void PresetShelf::load(std::string name) {
    ask([this, name = std::move(name)] {
        auto function = folder_.read(name);
        Outcome outcome = outcome_of(function ? base::Status() : function.error(), name, {});
        if (function) {
            outcome.loaded = *std::move(function);
        }
        return outcome;
    });
}

void PresetShelf::save(std::string name, view::AnchoredFunction function) {
    ask([this, name = std::move(name), function = std::move(function)] {
        return outcome_of(folder_.write(name, function), name, "saved as '" + name + "'");
    });
}

void PresetShelf::rename(std::string from, std::string to) {
    ask([this, from = std::move(from), to = std::move(to)] {
        const base::Status status = folder_.rename(from, to);
        return outcome_of(status, status ? to : from, "renamed to '" + to + "'");
    });
}

void PresetShelf::remove(std::string name) {
    ask([this, name = std::move(name)] {
        return outcome_of(folder_.remove(name), {}, "deleted '" + name + "'");
    });
}

void PresetShelf::ask(std::function<Outcome()> task) {
    errands_.ask([this, task = std::move(task)] {
        Outcome outcome = task();
        outcome.names = folder_.names();
        return std::optional(std::move(outcome));
    });
}

}  // namespace shearwater::ui
