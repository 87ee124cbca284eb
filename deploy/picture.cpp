#include "deploy/picture.h"

#include <algorithm>
#include <sstream>

namespace shearwater::deploy {
namespace {

std::string quoted(const std::string& text) {
    std::string out = "\"";
    for (const char c : base::printable(text)) {
        if (c == '"' || c == '\\') {
            out += '\\';
        }
        out += c;
    }
    return out + '"';
}

// Writes one JSON object, member by member.
class Object {
  public:
    explicit Object(std::ostream& out) : out_(out) { out_ << '{'; }
    template <class T>
    Object& add(const std::string& key, const T& value) {
        begin(key) << value;
        return *this;
    }
    std::ostream& begin(const std::string& key) {
        out_ << (first_ ? "" : ", ") << quoted(key) << ": ";
        first_ = false;
        return out_;
    }
    void end() { out_ << '}'; }

  private:
    std::ostream& out_;
    bool first_ = true;
};

}  // namespace

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
            .render = of(&Seconds::render),
            .composite = of(&Seconds::composite),
            .warp = of(&Seconds::warp),
            .encode = of(&Seconds::encode),
            .total = of(&Seconds::total)};
}

std::string to_json(const Picture& picture) {
    std::ostringstream out;
    Object root(out);
    const Seconds& s = picture.seconds;
    Object(root.begin("seconds"))
        .add("load", s.load)
        .add("preprocess", s.preprocess)
        .add("render", s.render)
        .add("composite", s.composite)
        .add("warp", s.warp)
        .add("encode", s.encode)
        .add("total", s.total)
        .end();
    root.add("samples", picture.samples);
    Object(root.begin("bricks"))
        .add("total", picture.bricks_total)
        .add("empty", picture.bricks_empty)
        .add("culled", 0)
        .add("rendered", picture.bricks_rendered)
        .end();
    Object(root.begin("bytes")).add("windows", picture.window_bytes).add("frame", picture.frame_bytes).end();
    Object memory(root.begin("peak_bytes"));
    for (const ProcessMemory& process : picture.memory) {
        memory.add(process.name, process.peak_bytes);
    }
    memory.end();
    root.add("tree", quoted(picture.tree));
    root.end();
    return out.str();
}

}  // namespace shearwater::deploy
