#pragma once
// A part of a cube under a transfer function, as rays sample it.

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "renderer/culling/block_cells.h"
#include "renderer/shear/brick_volume.h"
#include "tests/support/reference_cubes.h"

namespace shearwater::culling {

inline view::TransferFunction ramp(double x0, double a0, double x1, double a1) {
    return {.opacity_pins = {view::Ramp{x0, a0, x1, a1}}, .colour_pins = {{0, {1, 1, 1}}}};
}

// A block of a cube under a transfer function.
struct Block {
    const shear::BrickVolume& volume;
    shear::OpacityTable table;
    volume::Box box;

    Block(const shear::BrickVolume& of, const view::TransferFunction& tf, const volume::Box& part)
        : volume(of), table(tf, of.mapping().levels()), box(part) {}

    const shear::CodeVolume& nodes() const { return volume.level(0); }
    BlockCells cells() const {
        const LeastExtinctions extinctions(table, volume.mapping().bits, 1);
        return {cells_of_nodes(volume, 0, extinctions), box};
    }

    double code(const volume::Index3& p) const {
        return volume.mapping().bits == 8 ? nodes().codes<std::uint8_t>()[nodes().offset(p)]
                                          : nodes().codes<std::uint16_t>()[nodes().offset(p)];
    }
    // Optical depth along a unit of length at a point inside the cube: of the codes between its nodes.
    double extinction(const std::array<double, 3>& p) const {
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
                    return 0;  // blank in part: at most transparent
                }
                code += weight * c;
            }
        }
        const double node = code * static_cast<double>(table.nodes_per_code());
        const auto below = static_cast<std::size_t>(node);
        const double from = static_cast<double>(table.nodes()[below].extinction);
        const double to = static_cast<double>(table.nodes()[below + 1].extinction);
        return (from + (node - static_cast<double>(below)) * (to - from)) *
               static_cast<double>(table.depth_unit()) * std::numbers::ln2;
    }
    bool owns(const std::array<double, 3>& p) const {
        for (std::size_t a = 0; a < 3; ++a) {
            if (p[a] < static_cast<double>(box.lo[a]) || p[a] >= static_cast<double>(box.hi[a])) {
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
