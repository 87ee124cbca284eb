#include "deploy/bench/many_blocks.h"

#include <random>

#include "deploy/bench/machine.h"
#include "deploy/bench/options.h"
#include "deploy/bench/workload.h"

namespace shearwater::bench {

namespace {

const culling::DirectionGrid directions(culling::DirectionGrid::default_side);

}  // namespace

base::Status ManyBlocks::check_memory() {
    const volume::Index3 n{edge, edge, edge};
    const auto bytes = culling::BlockGrid(n).size() * static_cast<std::size_t>(directions.cells());
    return bench::check_memory("decide what is visible of " + cube_text(n), 3 * bytes);
}

std::string ManyBlocks::title() {
    const volume::Index3 n{edge, edge, edge};
    return cube_text(n) + ", " + std::to_string(culling::BlockGrid(n).size()) +
           " blocks with codes at random";
}

ManyBlocks::ManyBlocks(const MadeUp& codes, const deploy::ViewOptions& seen)
    : store_(grid_, directions),
      tf_{.opacity_pins = {}, .colour_pins = {{0, {1, 1, 1}}}, .background = {}},
      seen_(first_view(edge)) {
    seen_.size = seen.size;
    seen_.quality = seen.quality;
    seen_.drawing.lod = "off";
    for (int n = 0; n < codes.bases; ++n) {
        tf_.opacity_pins.emplace_back(view::Hat{0.25 + 0.5 * n, 0, 0.5, 1});
    }
    auto table = std::make_shared<culling::FunctionTable>(
        culling::FunctionTable{.blocks = {{}, grid_.counts()}, .side = directions.side(), .codes = {}});
    table->codes.resize(grid_.size() * static_cast<std::size_t>(directions.cells()));
    std::mt19937 random(1);
    for (std::uint8_t& code : table->codes) {
        code = static_cast<std::uint8_t>((random() >> 8) % static_cast<unsigned>(codes.codes));
    }
    for (const culling::Member& member : culling::members_of(tf_)) {
        for (const culling::Footprint footprint : culling::footprints_of(culling::Kind::opof)) {
            store_.put({footprint, member.basis, 0}, table);
        }
    }
}

view::Factorisation ManyBlocks::factorisation(int step, bool parallel) const {
    deploy::ViewOptions turned = seen_;
    turned.parallel = parallel;
    turned.orbit.azimuth += step * Path::turn;
    return view::factorise(*turned.camera(lattice_), *turned.image_size(), lattice_, turned.sampling());
}

culling::BlockSet ManyBlocks::visible(const view::Factorisation& factorisation, double threshold,
                                      base::Workers& workers, const culling::ImagePart& part) {
    return culling::visible_blocks(factorisation, grid_, store_.rates(tf_, culling::Kind::opof, 0, 1),
                                   {culling::Kind::opof, threshold}, workers, part);
}

}  // namespace shearwater::bench
