#include "common/synthetic/source.h"

#include <algorithm>
#include <charconv>
#include <vector>

#include "common/base/check.h"

namespace shearwater::synthetic {

namespace {

constexpr std::string_view scheme = "synthetic:";

std::vector<std::string_view> split(std::string_view text, char at) {
    std::vector<std::string_view> parts;
    for (;;) {
        const std::size_t end = text.find(at);
        parts.push_back(text.substr(0, end));
        if (end == std::string_view::npos) {
            return parts;
        }
        text.remove_prefix(end + 1);
    }
}

template <class Number>
bool read_number(std::string_view text, Number& number) {
    const char* const end = text.data() + text.size();
    const auto read = std::from_chars(text.data(), end, number);
    return read.ec == std::errc{} && read.ptr == end;
}

bool read_size(std::string_view text, volume::Index3& n) {
    const auto lengths = split(text, ',');
    if (lengths.size() != 1 && lengths.size() != 3) {
        return false;
    }
    for (std::size_t axis = 0; axis < 3; ++axis) {
        if (!read_number(lengths[lengths.size() == 1 ? 0 : axis], n[axis])) {
            return false;
        }
    }
    return true;
}

}  // namespace

bool is_synthetic(std::string_view path) {
    return path.starts_with(scheme);
}

base::Result<Name> parse(std::string_view path) {
    base::check(is_synthetic(path), "the path names a synthetic cube");
    const auto parts = split(path.substr(scheme.size()), ':');
    Name name;
    const bool sound = (parts.size() == 2 || parts.size() == 3) && read_size(parts[1], name.n) &&
                       (parts.size() == 2 || read_number(parts[2], name.seed));
    if (!sound) {
        return base::error(base::Code::invalid_argument, "open " + base::printable(path, 80),
                           "is not of the form synthetic:KIND:SIZE, like synthetic:random:256 or "
                           "synthetic:random:256,256,64");
    }
    name.kind = parts[0];
    return name;
}

std::string to_string(const Name& name) {
    std::string text(scheme);
    text += name.kind + ":" + std::to_string(name.n[0]) + "," + std::to_string(name.n[1]) + "," +
            std::to_string(name.n[2]);
    return name.seed == 1 ? text : text + ":" + std::to_string(name.seed);
}

base::Result<Source> Source::open(std::string_view path) {
    auto name = parse(path);
    if (!name) {
        return name.error();
    }
    auto field = make_field(name->kind, name->n, name->seed);
    if (!field) {
        return field.error();
    }
    const auto kind = std::ranges::find(kinds(), name->kind, &Kind::name);
    return Source(*std::move(name), *std::move(field), kind->bytes);
}

base::Status Source::read(const volume::Box& box, std::span<float> out) {
    base::check(volume::whole(name_.n).contains(box), "the box lies in the cube");
    base::check(static_cast<std::int64_t>(out.size()) == box.voxels(), "one float for each voxel");
    field_->fill(box, out);
    return {};
}

}  // namespace shearwater::synthetic
