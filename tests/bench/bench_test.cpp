// Every benchmark as it is typed: tiny runs, what they say, and mistakes. Nothing here is about speed.

#include <gmock/gmock.h>
#include <google/protobuf/struct.pb.h>
#include <google/protobuf/util/json_util.h>

#include <filesystem>
#include <map>
#include <set>

#include "deploy/samples/sample.h"
#include "tests/support/command.h"

namespace shearwater {
namespace {

using support::expect_mistake;
using support::Outcome;
using support::run;

using Line = google::protobuf::Struct;

std::vector<Line> parsed(const std::string& text) {
    std::vector<Line> lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) {
        Line object;
        const auto status = google::protobuf::util::JsonStringToMessage(line, &object);
        EXPECT_TRUE(status.ok()) << status.ToString() << "\n" << line;
        lines.push_back(object);
    }
    return lines;
}

double number(const Line& line, const std::string& key) {
    const auto found = line.fields().find(key);
    EXPECT_TRUE(found != line.fields().end() && found->second.has_number_value()) << key;
    return found == line.fields().end() ? 0 : found->second.number_value();
}

std::string text(const Line& line, const std::string& key) {
    const auto found = line.fields().find(key);
    EXPECT_TRUE(found != line.fields().end() && found->second.has_string_value()) << key;
    return found == line.fields().end() ? "" : found->second.string_value();
}

bool has_no(const Line& line, const std::string& key) {
    const auto found = line.fields().find(key);
    return found != line.fields().end() && found->second.has_null_value();
}

// The rows of a run, whose first line is the machine.
std::vector<Line> rows(const std::string& benchmark, const std::string& arguments) {
    const Outcome outcome = run("bench " + benchmark + " --json - " + arguments);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "");
    std::vector<Line> lines = parsed(outcome.out);
    EXPECT_GE(lines.size(), 2U);
    for (const Line& line : lines) {
        EXPECT_EQ(text(line, "bench"), benchmark);
    }
    if (!lines.empty()) {
        const Line machine = lines.front().fields().at("machine").struct_value();
        EXPECT_NE(text(machine, "cpu"), "");
        EXPECT_GE(number(machine, "cores"), 1);
        EXPECT_GT(number(machine, "memory_bytes"), 0);
        EXPECT_NE(text(machine, "simd"), "");
        EXPECT_NE(text(machine, "version"), "");
        lines.erase(lines.begin());
    }
    return lines;
}

void expect_times(const Line& line, double to_seconds = 1, const std::string& unit = "s") {
    const double median = number(line, "median_" + unit) * to_seconds;
    EXPECT_GT(median, 0);
    EXPECT_LT(median, 60);
    EXPECT_LE(number(line, "min_" + unit) * to_seconds, median);
}

TEST(Bench, Frame) {
    const auto lines = rows("frame", "--workload W1,W2,W3 --size 20 --image 40x30 --frames 2 --threads 2");
    ASSERT_EQ(lines.size(), 3U);
    for (const Line& line : lines) {
        expect_times(line);
        EXPECT_EQ(text(line, "cube"), "20x20x20");
        EXPECT_EQ(text(line, "view"), "perspective");
        EXPECT_EQ(number(line, "threads"), 2);
        EXPECT_EQ(number(line, "frames"), 2);
        EXPECT_GT(number(line, "samples"), 0);
        EXPECT_GT(number(line, "Gsamples_per_s"), 0);
        const double stages = number(line, "factorise_s") + number(line, "render_s") +
                              number(line, "warp_s") + number(line, "encode_s");
        EXPECT_LE(stages, number(line, "max_s") * 1.5);
    }
    EXPECT_EQ(text(lines[2], "workload"), "W3");
    const auto parallel = rows("frame", "--parallel --size 20 --image 40x30 --frames 1 --quality draft");
    EXPECT_EQ(text(parallel.at(0), "view"), "parallel");
}

TEST(Bench, FrameAlongEachAxisIsTheSameView) {
    const auto lines = rows("frame", "--axes --size 20 --image 40x40 --frames 1");
    ASSERT_EQ(lines.size(), 3U);
    EXPECT_EQ(text(lines[0], "view"), "along x");
    EXPECT_EQ(text(lines[2], "view"), "along z");
    for (const Line& line : lines) {
        EXPECT_NEAR(number(line, "samples"), number(lines[0], "samples"), number(lines[0], "samples") / 100);
    }
}

TEST(Bench, FrameOfAFile) {
    const support::TemporaryFolder scratch;
    const std::string cube = scratch.path("cube.fits");
    ASSERT_TRUE(samples::write_sample("nbody-web", {20, 30, 25}, 3, cube));
    std::ofstream(scratch.path("flat.toml")) << "[[opacity]]\nkind = \"flat\"\nheight = 0.2\n";
    const auto lines = rows("frame", cube + " --tf " + scratch.path("flat.toml") + " --frames 1 --bits 16");
    ASSERT_EQ(lines.size(), 1U);
    EXPECT_EQ(text(lines[0], "cube"), "20x30x25");
}

TEST(Bench, TreesStandBesideThePaper) {
    const auto lines = rows("trees", "--sizes 16,64 --nodes 1,3,7 --frames 2 --image 32x32");
    ASSERT_EQ(lines.size(), 6U);
    for (const Line& line : lines) {
        expect_times(line);
        EXPECT_NEAR(number(line, "frames_per_s") * number(line, "median_s"), 1, 1e-6);
    }
    EXPECT_EQ(number(lines[1], "renderers"), 2);
    EXPECT_EQ(number(lines[2], "renderers"), 4);
    EXPECT_TRUE(has_no(lines[1], "paper_s"));
    EXPECT_TRUE(has_no(lines[3], "paper_s"));
    EXPECT_EQ(number(lines[4], "paper_s"), 0.2);
    EXPECT_EQ(number(lines[5], "paper_s"), 0.18);
    EXPECT_NEAR(number(lines[4], "efficiency"), 1, 1e-6);
}

TEST(Bench, Images) {
    const auto lines = rows("images", "--images 16x16,100x100,40x20 --frames 1");
    ASSERT_EQ(lines.size(), 3U);
    EXPECT_EQ(number(lines[1], "paper_s"), 0.32);
    EXPECT_TRUE(has_no(lines[2], "paper_s"));
    for (const Line& line : lines) {
        EXPECT_EQ(number(line, "nodes"), 7);
        EXPECT_GT(number(line, "median_s"), 0);
        EXPECT_GT(number(line, "one_process_s"), 0);
    }
}

TEST(Bench, StagesAddUp) {
    const auto lines = rows("stages", "--size 16 --image 32x32 --frames 1 --tree 2,2");
    ASSERT_EQ(lines.size(), 7U);
    EXPECT_EQ(text(lines[0], "stage"), "render");
    EXPECT_EQ(text(lines[4], "stage"), "beyond render");
    EXPECT_EQ(text(lines[6], "stage"), "total");
    const double total = number(lines[6], "median_ms");
    EXPECT_NEAR(number(lines[0], "median_ms") + number(lines[4], "median_ms"), total, 1e-4 * total);
    EXPECT_GT(number(lines[4], "median_ms"), number(lines[2], "median_ms"))
        << "the warp comes after rendering";
    EXPECT_EQ(number(lines[6], "per_cent"), 100);
}

TEST(Bench, LoadMakesItsFileAndRemovesIt) {
    const support::TemporaryFolder scratch;
    for (const std::string bits : {"8", "16"}) {
        const auto lines =
            rows("load", "--size 24 --repeat 2 --bits " + bits + " --folder " + scratch.path(""));
        std::vector<std::string> stages;
        for (const Line& line : lines) {
            stages.push_back(text(line, "stage"));
            if (!stages.back().starts_with("stop: ")) {
                expect_times(line);
            }
        }
        const std::vector<std::string> expected{
            "read",        "read and count", "quantise in memory", "bricks from the file", "frame",
            "stop: frame", "stop: bricks",   "stop: count",        "picture of all"};
        EXPECT_EQ(stages, expected) << "so small a cube has no sketch";
        EXPECT_GT(number(lines[3], "MB_per_s"), 0);
        EXPECT_TRUE(std::filesystem::is_empty(scratch.path()));
    }
    const std::string cube = scratch.path("cube.fits");
    ASSERT_TRUE(samples::write_sample("ball", {20, 30, 25}, 3, cube));
    EXPECT_EQ(text(rows("load", cube + " --repeat 1").at(0), "cube"), "20x30x25");
    ASSERT_TRUE(samples::write_sample("random", {4000, 25, 25}, 3, cube));
    std::vector<std::string> stages;
    for (const Line& line : rows("load", cube + " --repeat 1")) {
        stages.push_back(text(line, "stage"));
    }
    EXPECT_NE(std::ranges::find(stages, "sketch"), stages.end());
    EXPECT_NE(std::ranges::find(stages, "stop: sketch"), stages.end());
}

TEST(Bench, KernelsByEveryKindOfVectors) {
    std::map<std::string, std::set<std::string>> of_simd;
    for (const Line& line : rows("kernels", "--seconds 0")) {
        expect_times(line, 1e-3, "ms");
        EXPECT_GT(number(line, "samples"), 0);
        of_simd[text(line, "simd")].insert(std::to_string(number(line, "bits")) + text(line, "blanks") +
                                           text(line, "hues"));
    }
    EXPECT_FALSE(of_simd.empty());
    for (const auto& [simd, kinds] : of_simd) {
        EXPECT_EQ(kinds.size(), 12U) << simd;
    }
}

TEST(Bench, Codecs) {
    const auto lines = rows("codecs", "--size 16 --image 32x32 --seconds 0 --threads 1");
    std::map<std::string, std::vector<std::string>> of_workload;
    for (const Line& line : lines) {
        expect_times(line, 1e-3, "ms");
        EXPECT_GT(number(line, "pixels"), 0);
        of_workload[text(line, "workload")].push_back(text(line, "what"));
        const bool codec = text(line, "what") == "rle encode" || text(line, "what") == "deflate of rle";
        EXPECT_TRUE(codec ? number(line, "bytes_left") > 0 : has_no(line, "bytes_left"));
    }
    EXPECT_EQ(of_workload.size(), 3U);
    for (const auto& [workload, what] : of_workload) {
        EXPECT_THAT(what, testing::ElementsAre("rle encode", "rle decode", "deflate of rle", "inflate to rle",
                                               "to 16 bits", "from 16 bits", "over", "over 16 bits",
                                               "window to spans", "merge two windows", "warp"))
            << workload;
    }
}

TEST(Bench, LargeNeedsNoFile) {
    const auto lines = rows("large", "--synthetic 40 --tree 4,2 --frames 1 --image 32x32 --workload W3");
    ASSERT_EQ(lines.size(), 1U);
    expect_times(lines[0]);
    EXPECT_EQ(number(lines[0], "renderers"), 4);
    EXPECT_GT(number(lines[0], "MiB_each"), 1);
    EXPECT_TRUE(has_no(lines[0], "paper_s"));
}

std::map<std::string, std::vector<Line>> by_table(const std::vector<Line>& lines) {
    std::map<std::string, std::vector<Line>> tables;
    for (const Line& line : lines) {
        tables[text(line, "table")].push_back(line);
    }
    return tables;
}

// Noise that is dense enough to hide what is behind it.
class CullingBench : public testing::Test {
  protected:
    CullingBench() {
        EXPECT_TRUE(samples::write_sample("noise-sources", {66, 66, 98}, 3, cube_));
        std::ofstream(tf_) << "[[opacity]]\nkind = \"ramp\"\nx0 = 0.3\na0 = 0.4\nx1 = 1\na1 = 0.9\n";
    }
    std::string arguments() const { return cube_ + " --range 0 255 --tf " + tf_ + " --image 96x80 "; }

  private:
    support::TemporaryFolder scratch_;
    std::string cube_ = scratch_.path("cube.fits"), tf_ = scratch_.path("fog.toml");
};

TEST_F(CullingBench, CountsTheBlocksThatEachWayLeaves) {
    for (const std::string view : {"", "--parallel "}) {
        const auto tables = by_table(rows("culling", arguments() + view + "--tables views --block 16"));
        const std::vector<Line>& lines = tables.at("views");
        ASSERT_EQ(lines.size(), 19U);
        for (const Line& line : lines) {
            const double opaque = number(line, "non_empty"), optimal = number(line, "optimal"),
                         opof = number(line, "opof");
            EXPECT_EQ(number(line, "blocks"), 5 * 5 * 7);
            EXPECT_LE(opaque, number(line, "blocks"));
            EXPECT_GT(optimal, opaque / 5);
            EXPECT_LE(optimal, opof);
            EXPECT_LE(optimal, number(line, "linear"));
            EXPECT_LE(number(line, "linear"), number(line, "pof"));
            EXPECT_LE(opof, number(line, "polynomial"));
            EXPECT_LE(number(line, "polynomial"), opaque);
            EXPECT_LE(number(line, "pof"), opaque);
            EXPECT_EQ(text(line, "in_order") == "yes" || text(line, "azimuth") == "mean",
                      opof <= number(line, "linear") || text(line, "azimuth") == "mean");
            EXPECT_NEAR(number(line, "opof_%"), 100 - 100 * opof / opaque, 1e-6);
            EXPECT_TRUE(has_no(line, "by_rays"));
            EXPECT_EQ(number(line, "missed"), 0);
        }
        EXPECT_EQ(text(lines[1], "azimuth"), "30");
        EXPECT_EQ(text(lines[18], "azimuth"), "mean");
        EXPECT_LT(number(lines[18], "opof"), 0.95 * number(lines[18], "non_empty"));
        EXPECT_LT(number(lines[18], "optimal"), number(lines[18], "opof"));
    }
}

TEST_F(CullingBench, FunctionsFramesFamiliesAndPasses) {
    const auto tables =
        by_table(rows("culling", arguments() + "--tables functions,frames,family,pass --frames 2"));
    ASSERT_EQ(tables.size(), 4U);
    ASSERT_EQ(tables.at("functions").size(), 12U);
    for (const Line& line : tables.at("functions")) {
        const double side = number(line, "side");
        EXPECT_EQ(number(line, "bytes_a_block"), side * side / 2);
        EXPECT_GT(number(line, "seconds"), 0);
        EXPECT_EQ(has_no(line, "paper_bytes"), side != 36);
        EXPECT_EQ(number(line, "polynomial_bytes"), 40);
    }
    ASSERT_EQ(tables.at("frames").size(), 4U);
    EXPECT_EQ(text(tables.at("frames")[0], "culling"), "off");
    for (const Line& line : tables.at("frames")) {
        expect_times(line);
        EXPECT_EQ(number(line, "cull_s") > 0, text(line, "culling") != "off");
        EXPECT_LE(number(line, "samples"), number(tables.at("frames")[0], "samples"));
    }
    ASSERT_EQ(tables.at("family").size(), 3U);
    for (const Line& line : tables.at("family")) {
        // One of each basis does for all heights.
        EXPECT_EQ(number(line, "computed") > 0, &line == tables.at("family").data());
        EXPECT_EQ(number(line, "again"), 0);
        EXPECT_EQ(number(line, "visible") + number(line, "culled"), number(line, "non_empty"));
    }
    ASSERT_EQ(tables.at("pass").size(), 3U);
    for (const Line& line : tables.at("pass")) {
        expect_times(line, 1e-3, "ms");
        EXPECT_GT(number(line, "first_ms"), 0);
    }
}

TEST_F(CullingBench, DragsAPin) {
    const auto lines = rows("culling", arguments() + "--tables drag --frames 2");
    ASSERT_EQ(lines.size(), 2U);
    EXPECT_EQ(text(lines[0], "culling"), "off");
    EXPECT_EQ(text(lines[1], "culling"), "opof");
    for (const Line& line : lines) {
        EXPECT_EQ(number(line, "pictures"), 4 * 2);
        EXPECT_LE(number(line, "min_ms"), number(line, "median_ms"));
        EXPECT_LE(number(line, "percentile_95_ms"), number(line, "max_ms"));
    }
}

TEST_F(CullingBench, ChecksPicturesAtRandom) {
    const auto lines = rows("culling", arguments() + "--check 3 --culling-threshold 0.9");
    ASSERT_EQ(lines.size(), 3U);
    for (const Line& line : lines) {
        EXPECT_EQ(number(line, "pictures"), 1);
        EXPECT_NEAR(number(line, "bound"), 0.1, 1e-9);
        EXPECT_LE(number(line, "greatest_difference"), 0.1);
        EXPECT_EQ(number(line, "over"), 0);
    }
}

TEST(Bench, TheTableAndTheLinesSayTheSame) {
    const support::TemporaryFolder scratch;
    const std::string json = scratch.path("lines.json");
    const Outcome outcome = run("bench frame --size 16 --image 20x20 --frames 1 --json " + json);
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_THAT(outcome.out, testing::HasSubstr("median s"));
    EXPECT_THAT(outcome.out, testing::HasSubstr("16x16x16"));
    EXPECT_THAT(outcome.out, testing::StartsWith("shearwater "));
    std::ostringstream lines;
    lines << std::ifstream(json).rdbuf();
    EXPECT_EQ(parsed(lines.str()).size(), 2U);
}

TEST(Bench, MistakesGetOneLine) {
    expect_mistake("bench", "benchmark");
    expect_mistake("bench paint", "paint");
    expect_mistake("bench frame --workload W9", "W9");
    expect_mistake("bench frame --size 1", "size");
    expect_mistake("bench frame --image pear", "pear");
    expect_mistake("bench frame --image 9999x9999", "--image");
    expect_mistake("bench frame --frames 0", "frames");
    expect_mistake("bench frame --quality best", "best");
    expect_mistake("bench frame /nowhere.fits", "nowhere");
    expect_mistake("bench frame /nowhere.fits --workload W1", "workload");
    expect_mistake("bench frame --tf some.toml", "cube");
    expect_mistake("bench frame --size 500000", "memory");
    expect_mistake("bench frame --json /nowhere/lines", "nowhere");
    expect_mistake("bench trees --nodes 5", "5");
    expect_mistake("bench trees --sizes 8,pear", "pear");
    expect_mistake("bench trees --image 0x5", "picture");
    expect_mistake("bench trees --sizes 2 --nodes 7", "too few");
    expect_mistake("bench images --size 8 --images 8x8,pear", "pear");
    expect_mistake("bench stages --tree 2", "tree");
    expect_mistake("bench stages --size 8 --tree 40,2", "too few");
    expect_mistake("bench load /nowhere.fits", "nowhere");
    expect_mistake("bench load --folder /nowhere", "nowhere");
    expect_mistake("bench load --bits 9", "bits");
    expect_mistake("bench codecs --seconds -1", "seconds");
    expect_mistake("bench kernels --seconds -1", "seconds");
    expect_mistake("bench culling --block 8", "block");
    expect_mistake("bench culling --tables views,pears", "pears");
    expect_mistake("bench culling --check 0", "check");
    expect_mistake("bench culling --culling-threshold 1", "threshold");
    expect_mistake("bench culling --tf some.toml", "cube");
    expect_mistake("bench culling /nowhere.fits", "nowhere");
    expect_mistake("bench large --synthetic 1000000", "memory");
    expect_mistake("bench large --colour 3", "colour");
}

TEST(Bench, HelpEndsWithZero) {
    for (const std::string benchmark :
         {"", "kernels", "frame", "trees", "images", "stages", "load", "codecs", "large", "culling"}) {
        const Outcome outcome = run("bench " + benchmark + " --help");
        EXPECT_EQ(outcome.status, 0);
        EXPECT_NE(outcome.out.find("--help"), std::string::npos);
    }
}

}  // namespace
}  // namespace shearwater
