#include "deploy/bench/paper.h"

#include <algorithm>
#include <array>

namespace shearwater::bench::paper {

namespace {

struct TableRow {
    std::int64_t edge;
    std::array<double, 4> seconds;
};
constexpr std::array<int, 4> table_nodes{3, 7, 15, 31};
constexpr std::array<TableRow, 5> table_1{{
    {64, {0.20, 0.18, 0.28, 0.41}},
    {128, {0.46, 0.32, 0.30, 0.40}},
    {256, {2.8, 1.5, 0.81, 0.56}},
    {512, {21, 11, 5.54, 3.9}},
    {1024, {290, 85, 43, 21}},
}};

struct ImageRow {
    int side;
    double seconds;
};
constexpr std::array<ImageRow, 3> table_2{{{100, 0.32}, {256, 0.36}, {512, 0.44}}};

}  // namespace

std::optional<double> tree_seconds(std::int64_t edge, int nodes) {
    const auto row = std::ranges::find(table_1, edge, &TableRow::edge);
    const auto column = std::ranges::find(table_nodes, nodes);
    if (row == table_1.end() || column == table_nodes.end()) {
        return std::nullopt;
    }
    return row->seconds[static_cast<std::size_t>(column - table_nodes.begin())];
}

std::optional<double> image_seconds(int side) {
    const auto row = std::ranges::find(table_2, side, &ImageRow::side);
    return row == table_2.end() ? std::nullopt : std::optional(row->seconds);
}

}  // namespace shearwater::bench::paper
