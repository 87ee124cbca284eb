#pragma once
// A part of a cube under a transfer function, as rays sample it.

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "common/culling/family.h"
#include "common/culling/rates.h"
#include "renderer/culling/block_cells.h"
#include "renderer/culling/least_extinctions.h"
#include "renderer/shear/brick_volume.h"
#include "renderer/shear/opacity_table.h"
#include "renderer/shear/segment_table.h"
#include "tests/support/reference_cubes.h"

namespace shearwater::culling {

inline view::TransferFunction ramp(double x0, double a0, double x1, double a1) {
    return {.opacity_pins = {view::Ramp{x0, a0, x1, a1}}, .colour_pins = {{0, {1, 1, 1}}}};
}

// A step much narrower than a code of 8 bits.
inline view::TransferFunction step(double at, double haze, double fog) {
    return ramp(at, haze, at + 0.001, fog);
}

// A block of a level's nodes of a cube under a transfer function of one pin. All places are counted in its
// nodes.
struct Block {
    const shear::BrickVolume& volume;
    Member member;
    shear::OpacityTable table;
    shear::SegmentTable segments;
    volume::Box box;
    int level;

    Block(const shear::BrickVolume& of, const view::TransferFunction& by, const volume::Box& part,
          int at_level = 0)
        : volume(of),
          member(members_of(by).at(0)),
          table(by, of.mapping().levels()),
          segments(by, of.mapping().levels(), table),
          box(part),
          level(at_level) {}

    const shear::CodeVolume& nodes() const { return volume.level(level); }
    // By a function's code, along a unit of length.
    double least_of(int code) const { return lifted(rate_of(code), member.height, 1); }
    LeastExtinctions extinctions() const { return {member.basis, volume.mapping()}; }
    BlockCells cells() const {
        const LeastExtinctions least = extinctions();
        return {cells_of_nodes(volume, level, least), box};
    }

    double code(const volume::Index3& p) const {
        return volume.mapping().bits == 8 ? nodes().codes<std::uint8_t>()[nodes().offset(p)]
                                          : nodes().codes<std::uint16_t>()[nodes().offset(p)];
    }
    // Interpolated at a point inside the cube; 0 where it is blank in part.
    double code_at(const std::array<double, 3>& p) const {
        std::array<std::int64_t, 3> lo;
        std::array<double, 3> f;
        for (std::size_t a = 0; a < 3; ++a) {
            lo[a] =
                std::min<std::int64_t>(static_cast<std::int64_t>(std::floor(p[a])), nodes().box().hi[a] - 1);
            f[a] = p[a] - static_cast<double>(lo[a]);
        }
        double code = 0;
        for (std::size_t corner = 0; corner < 8; ++corner) {
            volume::Index3 at;
            double weight = 1;
            for (std::size_t a = 0; a < 3; ++a) {
                const bool far = (corner >> a & 1) != 0;
                at[a] = lo[a] + (far ? 1 : 0);
                weight *= far ? f[a] : 1 - f[a];
            }
            if (weight > 0) {
                const double c = this->code(at);
                if (c == 0) {
                    return 0;
                }
                code += weight * c;
            }
        }
        return code;
    }
    // Optical depth along a unit of length at a point inside the cube: of the codes between its nodes.
    double extinction(const std::array<double, 3>& p) const { return sample_extinction(code_at(p)); }
    double sample_extinction(double code) const {
        if (code == 0) {
            return 0;  // at most transparent
        }
        const double node = code * static_cast<double>(table.nodes_per_code());
        const auto below = static_cast<std::size_t>(node);
        const double from = static_cast<double>(table.nodes()[below].extinction);
        const double to = static_cast<double>(table.nodes()[below + 1].extinction);
        return (from + (node - static_cast<double>(below)) * (to - from)) *
               static_cast<double>(table.depth_unit()) * std::numbers::ln2;
    }
    // Of the segment from one point to another, by its definition (shear/segments.h).
    double extinction(const std::array<double, 3>& p, const std::array<double, 3>& q) const {
        return segment_extinction(code_at(p), code_at(q));
    }
    double segment_extinction(double front, double back) const {
        if (front == 0 && back == 0) {
            return 0;
        }
        const auto node_of = [&](double code) { return segments.node_of(static_cast<float>(code)); };
        int from = node_of(front > 0 ? front : back), to = node_of(back > 0 ? back : front);
        if (from == to) {
            --from;
            ++to;
        }
        const auto depth = [&](int node) {
            const shear::SegmentTable::Node& at = segments.nodes()[node];
            return static_cast<double>(at.depth) + static_cast<double>(at.depth_rest);
        };
        return (depth(to) - depth(from)) / (to - from) * (front > 0 && back > 0 ? 1 : 0.5) *
               std::numbers::ln2;
    }
    // What of its cells the cube has.
    bool owns(const std::array<double, 3>& p) const {
        for (std::size_t a = 0; a < 3; ++a) {
            const double cube_end =
                static_cast<double>(volume.cube()[a] - 1) / static_cast<double>(1 << level);
            if (p[a] < static_cast<double>(box.lo[a]) ||
                p[a] >= std::min(static_cast<double>(box.hi[a]), cube_end)) {
                return false;
            }
        }
        return true;
    }
};

// Waves in which values vary slowly, from 0 to 1.
inline test::FloatCube shells(const volume::Index3& n) {
    return test::FloatCube(n, [](double x, double y, double z) {
        return static_cast<float>(0.5 + 0.5 * std::sin((x + 0.7 * y - 0.4 * z) / 4) * std::cos((y - z) / 7));
    });
}

}  // namespace shearwater::culling
