#include "client/model/edge_scales.h"

#include <algorithm>
#include <cmath>

#include "client/model/edge_line.h"
#include "client/model/world_steps.h"
#include "common/view/project.h"
#include "common/wcs/text.h"

namespace shearwater::model {

namespace {

constexpr double shortest = 40;    // pixels of an edge, in units of the style's gap of 4
constexpr int most_labels = 9;     // along an edge
constexpr std::size_t limit = 64;  // marks of any edge

struct Scene {
    const view::Camera& camera;
    const view::ImageSize& size;
    const view::Lattice& lattice;
    const ScaleStyle& style;

    view::Vec2 pixels_of(const Edge& edge, double t) const {
        return view::project(camera, size, lattice.world_from_voxel(edge.at(t))).at;
    }
    bool holds(const Plate& plate) const {
        return plate.from.x >= 0 && plate.from.y >= 0 && plate.from.x + plate.size.x <= size.width &&
               plate.from.y + plate.size.y <= size.height;
    }
};

// Away from what the picture shows of the box.
view::Vec2 outwards(const Part& part, const view::Vec2& middle) {
    const view::Vec2 way = part.to - part.from;
    const view::Vec2 normal = view::Vec2{way.y, -way.x} / glm::length(way);
    return glm::dot(normal, (part.from + part.to) / 2.0 - middle) < 0 ? -normal : normal;
}

// A plate beyond the line through `foot`, and at a distance from it.
Plate plate_beyond(view::Vec2 foot, view::Vec2 outward, double distance, view::Vec2 size) {
    const double reach = (std::abs(outward.x) * size.x + std::abs(outward.y) * size.y) / 2;
    return {foot + outward * (distance + reach) - size / 2.0, size};
}

bool apart(const std::vector<EdgeScale::Label>& labels, double gap) {
    for (std::size_t i = 1; i < labels.size(); ++i) {
        if (labels[i].plate.overlaps(labels[i - 1].plate, gap)) {
            return false;
        }
    }
    return true;
}

bool is_free(const Plate& plate, const std::vector<Plate>& taken, double gap) {
    return std::ranges::none_of(taken, [&](const Plate& other) { return plate.overlaps(other, gap); });
}

// An axis' values along one edge, as if there were no others.
struct Candidate {
    EdgeScale scale;
    Edge edge;
    Part part;
    view::Vec2 outward{};
    double worth = 0;
};

Candidate candidate(const Scene& scene, const Edge& edge, const Part& part, const wcs::Axis& axis,
                    double least_step, view::Vec2 middle) {
    Candidate made{.scale = {.along = edge.along}, .edge = edge, .part = part};
    made.outward = outwards(part, middle);
    const double length = glm::length(part.to - part.from);
    const double range = extent(edge, part, axis, scene.lattice.n);
    const ScaleStyle& style = scene.style;
    for (int wanted = most_labels; wanted > 0 && range > 0; --wanted) {
        const double step = world_step(axis, std::max(range / wanted, least_step));
        std::vector<EdgeScale::Mark> marks;
        std::vector<EdgeScale::Label> labels;
        for (const Crossing& at : crossings(edge, part, axis, scene.lattice.n, step, limit)) {
            const view::Vec2 foot = scene.pixels_of(edge, at.t);
            const std::string text = wcs::number_text(axis, at.value, step);
            marks.push_back({foot, foot + made.outward * style.mark});
            labels.push_back(
                {plate_beyond(foot, made.outward, style.mark + style.gap / 2, style.size_of(text)), text});
        }
        if (apart(labels, style.gap)) {
            made.scale.marks = std::move(marks);
            made.scale.labels = std::move(labels);
            break;
        }
    }
    const auto fitting = std::ranges::count_if(
        made.scale.labels, [&](const EdgeScale::Label& label) { return scene.holds(label.plate); });
    // Below and to the left is where one looks for scales.
    const view::Vec2 usual{-0.6, 0.8};
    made.worth = length * (1 + 0.25 * glm::dot(made.outward, usual)) * (fitting > 1 ? 1 : 0.1);
    return made;
}

// Where a title may stand: beside the labels, or in line with them past either end of the edge.
std::vector<Plate> places_for(const Scene& scene, const Candidate& chosen, view::Vec2 size) {
    const ScaleStyle& style = scene.style;
    const view::Vec2 outward = chosen.outward;
    double beyond = 0;
    for (const EdgeScale::Label& label : chosen.scale.labels) {
        beyond = std::max(
            beyond, std::abs(outward.x) * label.plate.size.x + std::abs(outward.y) * label.plate.size.y);
    }
    std::vector<Plate> places;
    for (const double share : {0.5, 0.35, 0.65, 0.2, 0.8, 0.05, 0.95}) {
        const double t = chosen.part.first + share * (chosen.part.last - chosen.part.first);
        places.push_back(plate_beyond(scene.pixels_of(chosen.edge, t), outward,
                                      style.mark + style.gap * 2 + beyond, size));
    }
    const view::Vec2 way = glm::normalize(chosen.part.to - chosen.part.from);
    const double reach = (std::abs(way.x) * size.x + std::abs(way.y) * size.y) / 2;
    for (const double gaps : {0.0, 2.0, 4.0, 6.0}) {
        const view::Vec2 past = way * (reach + gaps * style.gap);
        places.push_back(plate_beyond(chosen.part.to + past, outward, style.mark + style.gap / 2, size));
        places.push_back(plate_beyond(chosen.part.from - past, outward, style.mark + style.gap / 2, size));
    }
    return places;
}

// The axis' name, or a short one, where there is room.
std::optional<EdgeScale::Label> title_of(const Scene& scene, const Candidate& chosen, const wcs::Axis& axis,
                                         const std::vector<Plate>& taken) {
    for (const std::string& text : {wcs::title_text(axis), wcs::short_title_text(axis)}) {
        for (const Plate& plate : places_for(scene, chosen, scene.style.size_of(text))) {
            if (scene.holds(plate) && is_free(plate, taken, scene.style.gap)) {
                return EdgeScale::Label{plate, text};
            }
        }
    }
    return std::nullopt;
}

view::Vec2 middle_of(const Scene& scene, const volume::Box& box) {
    view::Vec3 voxel;
    for (int axis = 0; axis < 3; ++axis) {
        const auto a = static_cast<std::size_t>(axis);
        voxel[axis] = static_cast<double>(box.lo[a] + box.hi[a]) / 2;
    }
    return view::project(scene.camera, scene.size, scene.lattice.world_from_voxel(voxel)).at;
}

// Of the edges along each axis the one that serves best.
std::vector<Candidate> choose(const Scene& scene, const volume::Box& box, const wcs::Axes& world) {
    std::vector<Candidate> chosen;
    const view::Vec2 middle = middle_of(scene, box);
    for (const Edge& edge : outline(scene.camera, scene.size, scene.lattice, box)) {
        const auto part = part_in_picture(edge, scene.camera, scene.size, scene.lattice);
        if (!part || glm::length(part->to - part->from) < shortest * scene.style.gap / 4) {
            continue;
        }
        const double least_step = world[static_cast<std::size_t>(edge.along)].known() ? 0 : 1;
        Candidate made = candidate(scene, edge, *part, wcs::shown_axis(world, edge.along, scene.lattice.n),
                                   least_step, middle);
        if (chosen.empty() || chosen.back().edge.along != edge.along) {
            chosen.push_back(std::move(made));
        } else if (made.worth > chosen.back().worth) {
            chosen.back() = std::move(made);
        }
    }
    return chosen;
}

}  // namespace

bool Plate::overlaps(const Plate& other, double gap) const {
    return from.x < other.from.x + other.size.x + gap && other.from.x < from.x + size.x + gap &&
           from.y < other.from.y + other.size.y + gap && other.from.y < from.y + size.y + gap;
}

std::vector<EdgeScale> edge_scales(const view::Camera& camera, const view::ImageSize& size,
                                   const view::Lattice& lattice, const volume::Box& box,
                                   const wcs::Axes& world, const ScaleStyle& style) {
    const Scene scene{camera, size, lattice, style};
    std::vector<Candidate> chosen = choose(scene, box, world);
    std::vector<Plate> taken = style.reserved;
    for (Candidate& one : chosen) {
        std::erase_if(one.scale.labels, [&](const EdgeScale::Label& label) {
            if (scene.holds(label.plate) && is_free(label.plate, taken, style.gap)) {
                taken.push_back(label.plate);
                return false;
            }
            return true;
        });
    }
    // Marks that say nothing are none.
    std::erase_if(chosen, [](const Candidate& one) { return one.scale.labels.empty(); });
    std::vector<EdgeScale> scales;
    for (Candidate& one : chosen) {
        auto title = title_of(scene, one, wcs::shown_axis(world, one.edge.along, lattice.n), taken);
        one.scale.titled = title.has_value();
        if (title) {
            taken.push_back(title->plate);
            one.scale.labels.push_back(*std::move(title));
        }
        scales.push_back(std::move(one.scale));
    }
    return scales;
}

}  // namespace shearwater::model
