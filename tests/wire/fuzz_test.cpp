// Bounded runs, always the same, over everything that reads a peer's bytes. What is looked for are
// crashes, failed checks and what the sanitizers see; what is taken must be sound.

#include <gtest/gtest.h>

#include <random>

#include "common/image/canvas.h"
#include "protocol/wire/convert_look.h"
#include "tests/wire/examples.h"

namespace shearwater::wire::test {
namespace {

using Random = std::mt19937_64;

std::size_t below(Random& random, std::size_t bound) {
    return static_cast<std::size_t>(random() % bound);
}

// A few bytes changed, inserted, taken out, or the end cut off.
void mutate(std::vector<std::byte>& bytes, Random& random) {
    for (std::size_t n = 1 + below(random, 4); n > 0 && !bytes.empty(); --n) {
        const auto at = bytes.begin() + static_cast<std::ptrdiff_t>(below(random, bytes.size()));
        switch (below(random, 5)) {
            case 0:
                *at = static_cast<std::byte>(random());
                break;
            case 1:
                *at ^= static_cast<std::byte>(1U << below(random, 8));
                break;
            case 2:
                bytes.insert(at, static_cast<std::byte>(random()));
                break;
            case 3:
                bytes.erase(at);
                break;
            default:
                bytes.erase(at, bytes.end());
                break;
        }
    }
}

void convert(const Body& body) {
    if (const auto* view = std::get_if<pb::SetView>(&body)) {
        if (const auto from = view_from(*view)) {
            EXPECT_TRUE(view::validate(from->camera, from->size));
            for (const view::Camera& eye : cameras_of(*from)) {
                EXPECT_TRUE(view::validate(eye, from->size));
            }
            EXPECT_TRUE(view::validate(from->tf));
        }
    } else if (const auto* render = std::get_if<pb::Render>(&body)) {
        if (const auto from = factorisation_from(render->factorisation())) {
            EXPECT_TRUE(view::validate(*from));
        }
        if (const auto from = visible_from(*render, {100, 40, 33}); from && *from) {
            EXPECT_EQ((*from)->blocks.size(), (*from)->grid.size());
        }
        if (const auto from = mapping_from(render->sketch())) {
            EXPECT_LE(from->lo, from->hi);
        }
        if (const auto from = transfer_function_from(render->transfer_function())) {
            EXPECT_TRUE(view::validate(*from));
        }
    } else if (const auto* want = std::get_if<pb::WantFunctions>(&body)) {
        for (const pb::FunctionWant& one : want->wants()) {
            if (const auto from = function_key_from(one.key())) {
                EXPECT_TRUE(view::validate(culling::at_height(from->basis, 1)));
            }
        }
    } else if (const auto* functions = std::get_if<pb::Functions>(&body)) {
        // Whatever it says, a part has a byte for each of its blocks and directions.
        const auto from = functions_from(message(*functions, std::vector<std::byte>(4)));
        EXPECT_TRUE(!from || from->codes.size() == 4);
    } else if (const auto* give = std::get_if<pb::GiveFunctions>(&body)) {
        const auto from = given_functions_from(message(*give, std::vector<std::byte>(4)));
        EXPECT_TRUE(!from || from->part.codes.size() == 4);
    } else if (const auto* look = std::get_if<pb::Look>(&body)) {
        if (const auto from = look_from(*look)) {
            EXPECT_TRUE(view::validate(from->factorisation) && view::validate(from->tf));
            EXPECT_TRUE(culling::validate(from->settings));
        }
    } else if (const auto* replied = std::get_if<pb::Replied>(&body)) {
        if (const auto from = reply_from(*replied)) {
            EXPECT_LE(from->visible.size(), most_blocks);
        }
    } else if (const auto* pick = std::get_if<pb::Pick>(&body)) {
        if (const auto from = pick_from(*pick)) {
            EXPECT_TRUE(view::validate(from->camera, from->size));
            const auto ray = view::factorise_ray(from->camera, from->size, from->at, {.n = {9, 8, 7}});
            EXPECT_TRUE(view::is_ray(ray));
        }
    } else if (const auto* picked = std::get_if<pb::Picked>(&body)) {
        if (const auto from = pick_answer_from(*picked, {100, 40, 33}); from && from->hit) {
            EXPECT_LE(from->hit->voxel.x, 99);
        }
    } else if (const auto* probe = std::get_if<pb::Probe>(&body)) {
        if (const auto from = ray_from(*probe)) {
            EXPECT_TRUE(view::validate(*from) && view::is_ray(*from));
        }
    } else if (const auto* probed = std::get_if<pb::Probed>(&body)) {
        if (const auto from = ray_part_from(*probed)) {
            EXPECT_LE(from->samples.size(), most_ray_samples);
            EXPECT_TRUE(ray_part_from(to_wire(*from)));
        }
    } else if (const auto* assign = std::get_if<pb::Assign>(&body)) {
        if (const auto from = box_from(assign->box())) {
            EXPECT_GT(from->voxels(), 0);
        }
        if (const auto from = lattice_from(assign->cube().lattice())) {
            EXPECT_GT(volume::voxel_count(from->n), 0);
        }
        if (const auto from = mapping_from(assign->mapping())) {
            EXPECT_LE(from->lo, from->hi);
        }
    } else if (const auto* described = std::get_if<pb::CubeDescription>(&body)) {
        if (const auto from = summary_from(described->values())) {
            EXPECT_TRUE(volume::validate(*from));
        }
        if (const auto from = axes_from(described->axes())) {
            for (int along = 0; along < 3; ++along) {
                EXPECT_TRUE(wcs::validate((*from)[static_cast<std::size_t>(along)], along));
            }
        }
    } else if (const auto* report = std::get_if<pb::HistogramReport>(&body)) {
        if (const auto from = histogram_from(*report)) {
            EXPECT_LE(from->min(), from->max());
        }
    }
}

TEST(Fuzz, HeadersOfRandomBytes) {
    Random random(1);
    std::array<std::byte, header_bytes> bytes;
    const std::vector<Message> all = examples();
    for (int i = 0; i < 200000; ++i) {
        const std::vector<std::byte> head = encode_head(all[below(random, all.size())]);
        std::copy_n(head.begin(), header_bytes, bytes.begin());
        for (std::size_t n = below(random, 6); n > 0; --n) {
            bytes[below(random, bytes.size())] = static_cast<std::byte>(random());
        }
        if (const auto header = parse_header(bytes)) {
            const Limit* limit = limit_of(header->type);
            ASSERT_NE(limit, nullptr);
            EXPECT_LE(header->body, limit->body);
            EXPECT_LE(header->payload, limit->payload);
        }
    }
}

TEST(Fuzz, BodiesThatWereGood) {
    Random random(2);
    const std::vector<Message> all = all_examples();
    std::size_t taken = 0;
    for (int i = 0; i < 60000; ++i) {
        const Message& example = all[below(random, all.size())];
        const std::vector<std::byte> head = encode_head(example);
        std::vector<std::byte> body(head.begin() + header_bytes, head.end());
        mutate(body, random);
        const Header header{.version = 1,
                            .type = type_of(example.body),
                            .body = static_cast<std::uint32_t>(body.size()),
                            .payload = 0};
        if (const auto parsed = parse_body(header, body)) {
            ++taken;
            convert(*parsed);
        } else {
            EXPECT_EQ(parsed.error().reason, pb::REASON_MALFORMED);
        }
    }
    EXPECT_GT(taken, 1000U);
}

TEST(Fuzz, BodiesOfRandomBytes) {
    Random random(3);
    for (int i = 0; i < 60000; ++i) {
        std::vector<std::byte> body(below(random, 64));
        for (std::byte& b : body) {
            b = static_cast<std::byte>(random() % (i % 2 == 0 ? 256 : 32));
        }
        const auto type = static_cast<std::uint16_t>(below(random, 80));
        if (limit_of(type) != nullptr) {
            const auto size = static_cast<std::uint32_t>(body.size());
            if (const auto parsed =
                    parse_body({.version = 1, .type = type, .body = size, .payload = 0}, body)) {
                convert(*parsed);
            }
        }
    }
}

image::Window random_window(Random& random, int face, const view::Rect& rect) {
    image::Window window{
        .face = face, .rect = rect, .pixels = image::Image<image::RgbaF>(rect.width(), rect.height())};
    for (image::RgbaF& pixel : window.pixels.pixels()) {
        if (below(random, 3) == 0) {
            pixel = {0.25F, 0.5F, 0, static_cast<float>(below(random, 1000)) / 1000};
        }
    }
    return window;
}

// Windows that were good, with bytes changed, a rectangle of another's, or another band's. What is taken is
// merged both ways, which reads every span and must give the same.
TEST(Fuzz, WindowsOfAnyShape) {
    Random random(4);
    view::Factorisation f = factorisation();
    f.faces[0].width = 60;
    const std::vector<view::Band> bands = view::bands_of(f);
    ASSERT_EQ(bands.size(), 2U);
    image::Canvas canvas;
    canvas.begin(f);
    std::size_t taken = 0;
    for (int i = 0; i < 60000; ++i) {
        const std::size_t band = below(random, bands.size());
        const image::Window window =
            band == 0 ? random_window(random, 0, {3, 1, 4 + static_cast<int>(below(random, 50)), 4})
                      : random_window(random, 1, {0, 0, 3, 2});
        image::CodedWindows coded = image::encode({&window, 1});
        std::vector<std::byte> bytes(coded.bytes.begin(), coded.bytes.end());
        if (below(random, 4) != 0) {
            mutate(bytes, random);
        }
        Message sent = windows_message(1, band + 1, std::move(coded));
        sent.payload = std::make_shared<const base::Buffer>(bytes.begin(), bytes.end());
        for (pb::WindowHead& head : *std::get<pb::Windows>(sent.body).mutable_windows()) {
            if (below(random, 8) == 0) {
                const auto edge = [&] { return static_cast<int>(below(random, 60)) - 1; };
                *head.mutable_rect() = to_wire(view::Rect{edge(), edge() / 10, edge(), edge() / 10});
            }
        }
        std::get<pb::Windows>(sent.body).set_bands(static_cast<std::uint32_t>(below(random, 4)));
        const std::size_t known = below(random, 2);
        if (const auto got = windows_from(sent, bands, known)) {
            ++taken;
            ASSERT_TRUE(known < got->bands && got->bands <= bands.size());
            if (got->window.rect.empty()) {
                continue;
            }
            const view::Band& of = bands[got->bands - 1];
            EXPECT_EQ(got->window.face, of.face);
            EXPECT_EQ(view::intersection(got->window.rect, of.rect), got->window.rect);
            const std::vector<image::SpanWindow> twice(2, got->window);
            const image::CodedWindows merged = image::merge_coded(twice);
            EXPECT_EQ(image::merge_front_to_back(merged.windows).size(), 1U);
            canvas.lay(of, twice);
            EXPECT_TRUE(
                windows_from(windows_message(1, got->bands, image::merge_coded(twice)), bands, known));
        }
    }
    EXPECT_GT(taken, 1000U);
}

}  // namespace
}  // namespace shearwater::wire::test
