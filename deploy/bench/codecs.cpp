// bench codecs: what is done to pixels between the kernel and the window, on frames of each workload.

#include <CLI/CLI.hpp>
#include <optional>

#include "common/image/over.h"
#include "common/image/over_windows.h"
#include "common/image/rle.h"
#include "common/image/warp.h"
#include "deploy/bench/in_process.h"
#include "deploy/bench/options.h"
#include "deploy/bench/report.h"
#include "deploy/bench/subcommands.h"
#include "deploy/bench/workload.h"
#include "deploy/progress_bar.h"
#include "renderer/shear/render.h"

namespace shearwater::bench {
namespace {

struct CodecsFlags {
    Options common;
    std::int64_t edge = 128;
    double seconds = 0.3;
};

// A workload's frame, as the stages see it.
struct Frame {
    view::Camera camera;
    view::ImageSize size;
    view::Factorisation factorisation;
    std::vector<image::Window> windows;
    image::Image<image::Rgba8> picture;
};

Frame draw(const InProcess& cube, const view::Camera& camera, const view::ImageSize& size,
           view::Quality quality, const view::TransferFunction& tf) {
    Frame frame{.camera = camera,
                .size = size,
                .factorisation = view::factorise(camera, size, cube.lattice(), view::sampling(quality)),
                .windows = {},
                .picture = {}};
    frame.windows = shear::render(cube.bricks(), frame.factorisation, tf, cube.workers()).windows;
    frame.picture =
        image::warp(frame.factorisation, frame.windows, camera, size, tf.background, cube.workers());
    return frame;
}

class Codecs {
  public:
    Codecs(const CodecsFlags& flags, std::string workload, Report& report)
        : flags_(flags), workload_(std::move(workload)), report_(report) {}

    void time_picture(const image::Image<image::Rgba8>& picture) {
        const auto pixels = picture.pixels();
        const double bytes = static_cast<double>(pixels.size()) * sizeof(image::Rgba8);
        std::vector<std::byte> coded(image::rle_bound(pixels.size()));
        std::size_t length = 0;
        const Spread encode = measure(flags_.seconds, [&] { length = image::encode_rle(pixels, coded); });
        const std::span<const std::byte> runs(coded.data(), length);
        add("rle encode", 1, pixels.size(), encode, static_cast<double>(length) / bytes);
        std::vector<image::Rgba8> back(pixels.size());
        add("rle decode", 1, pixels.size(),
            measure(flags_.seconds, [&] { (void)image::decode_rle(runs, back); }));
        std::vector<std::byte> deflated;
        const Spread deflate = measure(flags_.seconds, [&] { deflated = image::deflate(runs); });
        add("deflate of rle", 1, pixels.size(), deflate, static_cast<double>(deflated.size()) / bytes);
        add("inflate to rle", 1, pixels.size(),
            measure(flags_.seconds, [&] { (void)image::inflate(deflated, length); }));
    }

    void time_window(const image::Window& window) {
        const auto pixels = window.pixels.pixels();
        std::vector<image::Rgba16> narrow(pixels.size());
        std::vector<image::RgbaF> wide(pixels.begin(), pixels.end());
        add("to 16 bits", 1, pixels.size(),
            measure(flags_.seconds, [&] { image::to_16_bits(pixels, narrow); }));
        add("from 16 bits", 1, pixels.size(),
            measure(flags_.seconds, [&] { image::from_16_bits(narrow, wide); }));
        add("over", 1, pixels.size(), measure(flags_.seconds, [&] { image::over(wide, pixels); }));
        add("over 16 bits", 1, pixels.size(), measure(flags_.seconds, [&] { image::over(wide, narrow); }));
        const std::span one(&window, 1);
        add("window to spans", 1, pixels.size(), measure(flags_.seconds, [&] { (void)image::encode(one); }));
        const image::CodedWindows coded = image::encode(one);
        const std::array two{coded.windows.front(), coded.windows.front()};
        add("merge two windows", 1, 2 * pixels.size(),
            measure(flags_.seconds, [&] { (void)image::merge_coded(two); }));
    }

    void time_warp(const Frame& frame, const view::Rgb& background, base::Workers& workers) {
        add("warp", workers.threads(), frame.picture.pixels().size(), measure(flags_.seconds, [&] {
                (void)image::warp(frame.factorisation, frame.windows, frame.camera, frame.size, background,
                                  workers);
            }));
    }

  private:
    void add(const std::string& what, int threads, std::size_t pixels, const Spread& times,
             std::optional<double> ratio = {}) {
        Record record;
        record.text("workload", workload_)
            .text("what", what, 17)
            .count("threads", static_cast<std::uint64_t>(threads))
            .count("pixels", pixels)
            .number("median_ms", times.median * 1e3, 3)
            .number("min_ms", times.least * 1e3, 3)
            .number("Mpixels_per_s", static_cast<double>(pixels) / times.median / 1e6, 0)
            .number("bytes_left", ratio, 3);
        report_.add(record);
    }

    const CodecsFlags& flags_;
    std::string workload_;
    Report& report_;
};

base::Status codecs(const CodecsFlags& flags) {
    const auto view = flags.common.view(flags.edge);
    if (!view) {
        return view.error();
    }
    const view::ImageSize size = *view->image_size();
    const view::Camera camera = *view->camera({.n = {flags.edge, flags.edge, flags.edge}});
    auto report = Report::open("codecs", flags.common.json);
    if (!report) {
        return report.error();
    }
    for (const std::string& name : workload_names()) {
        const Workload work = workload(name);
        deploy::ProgressBar bar(name);
        bar.show(0);
        auto cube = InProcess::load(work.cube(flags.edge), flags.common.threads,
                                    [&](double share) { bar.show(share); });
        if (!cube) {
            return cube.error();
        }
        const Frame frame = draw(*cube, camera, size, view->quality_value(), work.tf);
        Codecs timed(flags, name, *report);
        timed.time_picture(frame.picture);
        if (!frame.windows.empty()) {
            timed.time_window(*std::ranges::max_element(
                frame.windows, {}, [](const image::Window& window) { return window.rect.area(); }));
        }
        timed.time_warp(frame, work.tf.background, cube->workers());
    }
    report->note("bytes left: of four a pixel.");
    return report->close();
}

}  // namespace

Run add_codecs(CLI::App& app) {
    auto flags = std::make_shared<CodecsFlags>();
    add_size(app, flags->edge);
    app.add_option("--seconds", flags->seconds, "that each is done for")
        ->check(CLI::Range(0.0, 3600.0))
        ->capture_default_str();
    flags->common.add_image(app);
    flags->common.add_quality(app);
    flags->common.add_threads(app);
    flags->common.add_json(app);
    return [flags] { return status_of("codecs", codecs(*flags)); };
}

}  // namespace shearwater::bench
