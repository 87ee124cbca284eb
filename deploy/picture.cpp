#include "deploy/picture.h"

#include <algorithm>
#include <sstream>

#include "deploy/json.h"

namespace shearwater::deploy {
Seconds median(const std::vector<Seconds>& all) {
    const auto of = [&](double Seconds::*member) {
        std::vector<double> values;
        for (const Seconds& seconds : all) {
            values.push_back(seconds.*member);
        }
        std::ranges::sort(values);
        const std::size_t middle = values.size() / 2;
        if (values.empty()) {
            return 0.0;
        }
        return values.size() % 2 == 1 ? values[middle] : (values[middle - 1] + values[middle]) / 2;
    };
    return {.load = of(&Seconds::load),
            .preprocess = of(&Seconds::preprocess),
            .look = of(&Seconds::look),
            .render = of(&Seconds::render),
            .composite = of(&Seconds::composite),
            .warp = of(&Seconds::warp),
            .encode = of(&Seconds::encode),
            .total = of(&Seconds::total),
            .interval = of(&Seconds::interval)};
}

std::string to_json(const Picture& picture) {
    std::ostringstream out;
    JsonObject root(out);
    const Seconds& s = picture.seconds;
    JsonObject(root.begin("seconds"))
        .add("load", s.load)
        .add("preprocess", s.preprocess)
        .add("look", s.look)
        .add("render", s.render)
        .add("composite", s.composite)
        .add("warp", s.warp)
        .add("encode", s.encode)
        .add("total", s.total)
        .end();
    root.add("samples", picture.samples);
    JsonObject(root.begin("bricks"))
        .add("total", picture.bricks_total)
        .add("empty", picture.bricks_empty)
        .add("culled", picture.bricks_culled)
        .add("rendered", picture.bricks_rendered)
        .end();
    root.add("culling_by", quoted(picture.culling_by));
    JsonObject(root.begin("bytes"))
        .add("windows", picture.window_bytes)
        .add("frame", picture.frame_bytes)
        .end();
    JsonObject memory(root.begin("peak_bytes"));
    for (const ProcessMemory& process : picture.memory) {
        memory.add(process.name, process.peak_bytes);
    }
    memory.end();
    root.add("tree", quoted(picture.tree));
    root.end();
    return out.str();
}

}  // namespace shearwater::deploy
