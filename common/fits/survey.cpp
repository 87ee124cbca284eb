#include "common/fits/survey.h"

#include "common/fits/tiles.h"

namespace shearwater::fits {

namespace {

using base::Code;

constexpr int most_hdus = 4096;

bool holds_cube(const Hdu& hdu) {
    return hdu.is_image() && (hdu.long_axes() == 3 || hdu.long_axes() == 4);
}

std::string described(const Hdu& hdu) {
    switch (hdu.kind) {
        case HduKind::image:
        case HduKind::compressed_image:
            return hdu.axes.empty() ? "empty" : "an image of " + hdu.shape();
        case HduKind::random_groups:
            return "random groups";
        case HduKind::table:
            return "a table";
        case HduKind::other:
            break;
    }
    return "of an unknown kind";
}

// One more HDU, with its image's shape where it is compressed.
base::Result<std::optional<Hdu>> next_hdu(const Bytes& bytes, std::int64_t offset, int number,
                                          const std::string& operation) {
    auto hdu = read_hdu(bytes, offset, number, operation);
    if (hdu && *hdu && (*hdu)->kind == HduKind::compressed_image) {
        if (base::Status shape = read_compressed_shape(**hdu, operation); !shape) {
            return shape.error();
        }
    }
    return hdu;
}

base::Error no_cube(const std::vector<std::string>& seen, const std::optional<int>& wanted,
                    const std::string& operation) {
    if (wanted) {
        return base::error(
            Code::invalid_argument, operation,
            "HDU " + std::to_string(*wanted) + " is asked for, but the file has " +
                (seen.size() == 1 ? "only HDU 0" : "HDUs 0 to " + std::to_string(seen.size() - 1)));
    }
    std::string list;
    constexpr std::size_t listed = 4;
    for (std::size_t i = 0; i < seen.size() && i < listed; ++i) {
        list += (i == 0 ? "" : ", ") + std::string("HDU ") + std::to_string(i) + " is " + seen[i];
    }
    return base::error(Code::unsupported, operation,
                       "not a cube: no HDU is an image with three axes longer than 1 (" + list +
                           (seen.size() > listed ? ", ..." : "") + ")");
}

// What else the file holds. Faults behind the cube do it no harm.
void look_behind(const Bytes& bytes, Survey& survey, bool asked_for, const std::string& operation) {
    std::int64_t offset = survey.cube.next_offset;
    std::string others;
    for (int number = survey.cube.number + 1; number < most_hdus; ++number) {
        const auto hdu = next_hdu(bytes, offset, number, operation);
        if (!hdu) {
            survey.notes.push_back("what follows HDU " + std::to_string(number - 1) +
                                   " is damaged and ignored");
            break;
        }
        if (!*hdu) {
            break;
        }
        if (holds_cube(**hdu)) {
            others += (others.empty() ? "" : ", ") + std::to_string(number);
        }
        offset = (*hdu)->next_offset;
    }
    if (bytes.size() > offset) {
        survey.notes.push_back(std::to_string(bytes.size() - offset) +
                               " bytes after the last HDU are ignored");
    }
    if (!others.empty() && !asked_for) {
        survey.notes.push_back("HDU " + std::to_string(survey.cube.number) + " is used; HDU " + others +
                               " of the file can be chosen too");
    }
}

}  // namespace

base::Result<Survey> find_cube(const Bytes& bytes, const std::optional<int>& wanted,
                               const std::string& operation) {
    std::vector<std::string> seen;
    std::int64_t offset = 0;
    if (wanted && *wanted < 0) {
        return base::error(Code::invalid_argument, operation, "HDUs are counted from 0");
    }
    for (int number = 0; number < most_hdus; ++number) {
        auto hdu = next_hdu(bytes, offset, number, operation);
        if (!hdu) {
            return hdu.error();
        }
        if (!*hdu) {
            break;
        }
        seen.push_back(described(**hdu));
        offset = (*hdu)->next_offset;
        if (wanted ? number != *wanted : !holds_cube(**hdu)) {
            continue;
        }
        if (!(*hdu)->is_image()) {
            return base::error(Code::unsupported, operation,
                               "HDU " + std::to_string(number) + " is " + seen.back() + ", not an image");
        }
        Survey survey{.cube = std::move(**hdu), .notes = {}};
        if (base::Status present = check_present(survey.cube, bytes, operation); !present) {
            return present.error();
        }
        look_behind(bytes, survey, wanted.has_value(), operation);
        return survey;
    }
    return no_cube(seen, wanted, operation);
}

}  // namespace shearwater::fits
