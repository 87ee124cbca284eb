// The bytes of version 1, kept for ever: a peer of that version sends and expects exactly these.

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/wire/examples.h"

namespace shearwater::wire::test {
namespace {

std::string hex(std::span<const std::byte> bytes) {
    constexpr std::string_view digits = "0123456789abcdef";
    std::string text;
    for (const std::byte b : bytes) {
        text += digits[std::to_integer<std::size_t>(b) / 16];
        text += digits[std::to_integer<std::size_t>(b) % 16];
    }
    return text;
}

// In Body's order: header, body.
const std::vector<std::string> version_1{
    // Challenge
    "5357545201000100160000000000000000000000"
    "080110021a1030313233343536373839616263646566",
    // Hello
    "5357545201000200340000000000000000000000"
    "0804100118022210666564636261393837363534333231302a106e6f742061207265616c2070726f6f6632086e6f6465"
    "372f3432",
    // Welcome
    "53575452010003000f0000000000000000000000"
    "0801120b6e6f722069732074686973",
    // Goodbye
    "5357545201000400100000000000000000000000"
    "080e120c616e6f746865722063616d65",
    // Ping
    "5357545201000500030000000000000000000000"
    "08ac02",
    // Pong
    "5357545201000600030000000000000000000000"
    "08ac02",
    // Join
    "5357545201001000170000000000000000000000"
    "0803120831302e302e302e37188c4720082a046c656674",
    // Assign
    "53575452010011009a0000000000000000000000"
    "08b5b8f0fe2d10021a110a0410021804120908800110820118d804220831302e302e302e3128a8463215080512110a04"
    "10021804120908800110820118d8043a3f0a0f2f646174612f637562652e666974731001180122280a0908800110c801"
    "18da04121b09000000000000f03f11000000000000004019000000000000e03f421609000000000000f8bf1100000000"
    "00000440180320104810",
    // Report
    "5357545201001200260000000000000000000000"
    "0802100619000000000000e03f208080402880808001320c6e6f20737563682066696c653801",
    // Adopt
    "5357545201002000080000000000000000000000"
    "08b5b8f0fe2d1002",
    // HistogramReport
    "5357545201002100230000000000000000000000"
    "0a0203041204808020011a0307e807200229000000000000e03f31000000000000f83f",
    // SetMapping
    "5357545201002200180000000000000000000000"
    "0a1609000000000000f8bf11000000000000044018032010",
    // NeedVoxels
    "5357545201002300170000000000000000000000"
    "080310091a110a0410021804120908800110820118d804",
    // Voxels
    "53575452010024001d0000000400000000000000"
    "080310091a110a0410021804120908800110820118d8042204676f6e65",
    // Render
    "53575452010025008f0100000000000000000000"
    "081112ac0112280a0908800110c80118da04121b09000000000000f03f11000000000000004019000000000000e03f1a"
    "1b090000000000002440110000000000003440190000000000407fc0220919000000000000f03f2a2c08021002180520"
    "0429000000000000e0bf31000000000000d0bf39000000000000d03f41000000000000c03f2a2a100118032002290000"
    "00000000e03f31000000000000f0bf39000000000000e03f41000000000000e03f1adb010a1d0a1b09000000000000d0"
    "3f19000000000000f03f21000000000000e03f0a26122409000000000000e03f11000000000000c03f19000000000000"
    "d03f21000000000000e83f0a0b1a0909000000000000b03f0a14221209000000000000d03f11000000000000d83f1202"
    "1200122609000000000000e03f121b09000000000000f03f11000000000000e03f19000000000000d03f122609000000"
    "000000f03f121b09000000000000f03f11000000000000f03f19000000000000f03f1a1b09000000000000c03f110000"
    "00000000d03f19000000000000e03f",
    // Cancel
    "5357545201002600020000000000000000000000"
    "0811",
    // Windows
    "53575452010027004b0000000800000000000000"
    "0811120a080112060802180420021a15080312110a0410021804120908800110820118d804222409000000000000d03f"
    "11000000000000c03f18c0843d2080042864309c03388080808020",
    // WantFunctions, since version 4; a key has had a rung
    "5357545201002800740000000000000000000000"
    "0a6c080612650801125f0a26122409000000000000e03f11000000000000c03f19000000000000d03f210000000000"
    "00f03f0a14221209000000000000d03f11000000000000d83f121d121b09000000000000f03f11000000000000f03f"
    "19000000000000f03f1a0020011a0103102018242001",
    // Functions, since version 4
    "5357545201002900180000000400000000000000"
    "080610031801220a0a001206080410021802280430063802",
    // CubeDescription
    "5357545201004000600000000000000000000000"
    "0a09637562652e6669747312084e474320363934361a074a592f4245414d22280a0908800110c80118da04121b090000"
    "00000000f03f11000000000000004019000000000000e03f2a1609000000000000f8bf11000000000000044018032010",
    // TreeState
    "53575452010041003e0000000000000000000000"
    "0a3a08011001180222056e6f6465372a110a0410021804120908800110820118d804300539000000000000f03f408080"
    "40488080800152046e6f6e651001",
    // SetView
    "5357545201004200330100000000000000000000"
    "080512470a1b09000000000000f03f110000000000000040190000000000000840120909000000000000e03f1a091100"
    "0000000000f03f2001290000000000003e4031000000000000594018800520e0032adb010a1d0a1b09000000000000d0"
    "3f19000000000000f03f21000000000000e03f0a26122409000000000000e03f11000000000000c03f19000000000000"
    "d03f21000000000000e83f0a0b1a0909000000000000b03f0a14221209000000000000d03f11000000000000d83f1202"
    "1200122609000000000000e03f121b09000000000000f03f11000000000000e03f19000000000000d03f122609000000"
    "000000f03f121b09000000000000f03f11000000000000f03f19000000000000f03f1a1b09000000000000c03f110000"
    "00000000d03f19000000000000e03f30023801",
    // Frame
    "5357545201004300660000000300000000000000"
    "0812100518800520e00328013215080312110a0410021804120908800110820118d8043a410a2409000000000000d03f"
    "11000000000000c03f18c0843d2080042864309c0338808080802011000000000000e03f19000000000000d03f210000"
    "00000000f03f",
    // FrameShown
    "5357545201004400020000000000000000000000"
    "0812",
    // Pick, since version 4, as what follows
    "5357545201004600410100000000000000000000"
    "080912470a1b09000000000000f03f110000000000000040190000000000000840120909000000000000e03f1a091100"
    "0000000000f03f2001290000000000003e4031000000000000594018800520e003290000000000087440310000000000"
    "001e403adb010a1d0a1b09000000000000d03f19000000000000f03f21000000000000e03f0a26122409000000000000"
    "e03f11000000000000c03f19000000000000d03f21000000000000e83f0a0b1a0909000000000000b03f0a1422120900"
    "0000000000d03f11000000000000d83f12021200122609000000000000e03f121b09000000000000f03f110000000000"
    "00e03f19000000000000d03f122609000000000000f03f121b09000000000000f03f11000000000000f03f1900000000"
    "0000f03f1a1b09000000000000c03f11000000000000d03f19000000000000e03f",
    // Picked
    "5357545201004700350000000000000000000000"
    "080910011a1b09000000000000f83f110000000000000040190000000000000a4021000000000000e83f290000000000"
    "00e0bf3001",
    // Probe
    "5357545201004800650100000000000000000000"
    "081312820112280a0908800110c80118da04121b09000000000000f03f11000000000000004019000000000000e03f1a"
    "1b090000000000002440110000000000003440190000000000407fc0220919000000000000f03f2a2c08021002180120"
    "0129000000000000e0bf31000000000000d0bf39000000000000f03f41000000000000f03f30011adb010a1d0a1b0900"
    "0000000000d03f19000000000000f03f21000000000000e03f0a26122409000000000000e03f11000000000000c03f19"
    "000000000000d03f21000000000000e83f0a0b1a0909000000000000b03f0a14221209000000000000d03f1100000000"
    "0000d83f12021200122609000000000000e03f121b09000000000000f03f11000000000000e03f19000000000000d03f"
    "122609000000000000f03f121b09000000000000f03f11000000000000f03f19000000000000f03f1a1b090000000000"
    "00c03f11000000000000d03f19000000000000e03f",
    // Probed
    "5357545201004900170000000000000000000000"
    "081312030e01051a0c0000003f0000803e000000402001",
    // GiveFunctions
    "5357545201002a00830000000400000000000000"
    "081512650801125f0a26122409000000000000e03f11000000000000c03f19000000000000d03f21000000000000f03f"
    "0a14221209000000000000d03f11000000000000d83f121d121b09000000000000f03f11000000000000f03f19000000"
    "000000f03f1a0020011a18080610031801220a0a001206080410021802280430063802",
    // Look
    "5357545201002b00a50100000000000000000000"
    "081612ac0112280a0908800110c80118da04121b09000000000000f03f11000000000000004019000000000000e03f1a"
    "1b090000000000002440110000000000003440190000000000407fc0220919000000000000f03f2a2c08021002180520"
    "0429000000000000e0bf31000000000000d0bf39000000000000d03f41000000000000c03f2a2a100118032002290000"
    "00000000e03f31000000000000f0bf39000000000000e03f41000000000000e03f1adb010a1d0a1b09000000000000d0"
    "3f19000000000000f03f21000000000000e03f0a26122409000000000000e03f11000000000000c03f19000000000000"
    "d03f21000000000000e83f0a0b1a0909000000000000b03f0a14221209000000000000d03f11000000000000d83f1202"
    "1200122609000000000000e03f121b09000000000000f03f11000000000000e03f19000000000000d03f122609000000"
    "000000f03f121b09000000000000f03f11000000000000f03f19000000000000f03f1a1b09000000000000c03f110000"
    "00000000d03f19000000000000e03f220b080311666666666666ee3f2a0206073203030406",
    // Replied
    "5357545201002c00090000000000000000000000"
    "081610011a03058000",
};

TEST(Bytes, OfEveryMessageAreThoseOfVersionOne) {
    const std::vector<Message> all = examples();
    ASSERT_EQ(all.size(), version_1.size());
    for (std::size_t i = 0; i < all.size(); ++i) {
        EXPECT_EQ(hex(encode_head(all[i], 1)), version_1[i]) << name(all[i].body);
    }
}

std::string body_of(const Message& message) {
    constexpr std::size_t header_digits = 2 * header_bytes;
    return hex(encode_head(message)).substr(header_digits);
}

// What a wish about levels of detail adds to a request without one: the body's end, two bytes longer.
TEST(Bytes, OfAViewWithOrWithoutLevels) {
    View view = view_request();
    const std::string as_the_server_has_it = body_of(message(to_wire(view)));
    view.level_of_detail = false;
    EXPECT_EQ(body_of(message(to_wire(view))), as_the_server_has_it + "4001");
    view.level_of_detail = true;
    EXPECT_EQ(body_of(message(to_wire(view))), as_the_server_has_it + "4000");
}

// What sketches add, at the end of bodies whose beginnings are as before: whoever knows none passes over it.
TEST(Bytes, OfWhatHasToDoWithSketches) {
    const std::string added[] = {"5003", "3801", "221609000000000000f8bf11000000000000044018032010",
                                 "3001", "4801", "4001"};
    const std::vector<Message> sketches = sketch_examples();
    ASSERT_EQ(sketches.size(), std::size(added));
    for (std::size_t i = 0; i < sketches.size(); ++i) {
        for (const Message& plain : examples()) {
            if (plain.body.index() == sketches[i].body.index()) {
                EXPECT_EQ(body_of(sketches[i]), body_of(plain) + added[i]) << name(plain.body);
            }
        }
    }
}

// What culling adds, likewise.
TEST(Bytes, OfWhatHasToDoWithCulling) {
    const std::vector<Message> culling = culling_examples();
    const std::vector<Message> plain = examples();
    const auto of = [&](const Message& changed) {
        return body_of(*std::ranges::find(plain, changed.body.index(),
                                          [](const Message& message) { return message.body.index(); }));
    };
    EXPECT_EQ(body_of(culling.at(0)), of(culling[0]) + "2820320103");
    EXPECT_EQ(body_of(culling.at(1)).size(), of(culling[1]).size() + 4);  // within the stats
    EXPECT_EQ(body_of(culling.at(2)), of(culling[2]) + "5a0b080311000000000000e83f");
}

// What two eyes, a box to crop to and limits add.
TEST(Bytes, OfPairsAndCrops) {
    const std::string box = "0a060802100418061206085010641878";
    View view = view_request();
    const std::string plain = body_of(message(to_wire(view)));
    view.stereo = view::StereoSettings{1, 2, true};
    view.crop = volume::Box{{1, 2, 3}, {40, 50, 60}};
    EXPECT_EQ(body_of(message(to_wire(view))),
              plain + "a2011409000000000000f03f1100000000000000401801" + "aa0110" + box);
    const std::string paired = body_of(message(to_wire(view)));
    view.scaling = volume::Scaling{1, 2, volume::Stretch::log};
    EXPECT_EQ(body_of(message(to_wire(view))), paired + "b2011409000000000000f03f1100000000000000401802");
    view.camera.slant = {0.25, -0.5};
    const std::string slanted = body_of(message(to_wire(view)));
    EXPECT_NE(slanted.find("a101000000000000d03fa901000000000000e0bf"), std::string::npos) << slanted;
    view::Factorisation cropped = factorisation();
    pb::Render render;
    *render.mutable_factorisation() = to_wire(cropped);
    cropped.crop = view.crop;
    pb::Render of_part;
    *of_part.mutable_factorisation() = to_wire(cropped);
    EXPECT_EQ(body_of(message(of_part)).substr(8),
              body_of(message(render)).substr(8) + "a20110" + box);  // behind the lengths
    pb::Frame pair;
    pair.set_eyes(2);
    EXPECT_EQ(body_of(message(pair)), "a00102");
}

// What the editor of transfer functions adds. A hat's lean and a density lie within the view's function; a
// summary of values ends a description, its quantiles as a block of doubles.
TEST(Bytes, OfWhatTheEditorShowsAndMakes) {
    const std::vector<Message> editor = editor_examples();
    const std::vector<Message> plain = examples();
    const auto of = [&](const Message& changed) {
        return body_of(*std::ranges::find(plain, changed.body.index(),
                                          [](const Message& message) { return message.body.index(); }));
    };
    const std::string described = body_of(editor.at(0)), before = of(editor[0]);
    EXPECT_EQ(described.substr(0, before.size()), before);
    EXPECT_EQ(described.substr(before.size(), 124),
              "f201fa3e"    // 30: 8058 bytes
              "0a0301ac02"  // counts
              "1002"
              "1803"
              "2004"                // below, above, blank
              "2900000000000000c0"  // min, max, median, sigma
              "310000000000001040"
              "39000000000000e03f"
              "41000000000000d03f"
              "4ac83e"  // 1001 quantiles of 8 bytes, the first
              "00000000000000c0");
    EXPECT_EQ(described.size() - before.size(), 2 * (4 + 8058));
    const std::string view = body_of(editor.at(1));
    EXPECT_NE(view.find("21000000000000e83f"
                        "f101000000000000b03f"),
              std::string::npos)
        << "height, lean";
    EXPECT_NE(view.find("f1010000000000000040"), std::string::npos) << "density";
    EXPECT_EQ(view.size(), of(editor[1]).size() + 2 * (10 + 10));
}

// What world coordinates add at a description's end, axis by axis.
TEST(Bytes, OfWorldCoordinates) {
    const std::vector<Message> plain = examples();
    const std::string described = body_of(world_examples().at(0));
    const std::string before = body_of(*std::ranges::find_if(plain, [](const Message& message) {
        return std::holds_alternative<pb::CubeDescription>(message.body);
    }));
    EXPECT_EQ(described.substr(0, before.size()), before);
    EXPECT_EQ(described.substr(before.size(), 66),
              "c20255"                              // 40: 85 bytes
              "0a0f726967687420617363656e73696f6e"  // name, label, unit
              "12025241"
              "1a03646567"
              "20012801");  // hours, a circle
    EXPECT_EQ(described.substr(described.size() - 2 * 53),
              "c20232"
              "0a0e726164696f2076656c6f63697479"
              "120356656c"
              "1a046b6d2f73"
              "3203010102"                              // nodes
              "3a1000000000000059c00000000000005940");  // values
}

// And what pre-integrated classification does, of a view and of a factorisation.
TEST(Bytes, OfPreIntegratedClassification) {
    constexpr std::size_t header_digits = 2 * header_bytes;
    const auto body = [](const Message& whole) { return hex(encode_head(whole)).substr(header_digits); };
    View view = view_request();
    const std::string post = body(message(to_wire(view)));
    view.classify = view::Classify::pre_integrated;
    EXPECT_EQ(body(message(to_wire(view))), post + "5001");
    pb::Factorisation plain = to_wire(factorisation());
    view::Factorisation changed = factorisation();
    changed.classify = view::Classify::pre_integrated;
    EXPECT_EQ(to_wire(changed).SerializeAsString(), plain.SerializeAsString() + "\x38\x01");
}

TEST(Bytes, OfRaysThatAreDoneSooner) {
    const pb::Factorisation plain = to_wire(factorisation());
    view::Factorisation changed = factorisation();
    changed.opaque = 0.75;
    using namespace std::string_literals;
    EXPECT_EQ(to_wire(changed).SerializeAsString(),
              plain.SerializeAsString() + "\x41\x00\x00\x00\x00\x00\x00\xe8\x3f"s);
    EXPECT_EQ(factorisation_from(to_wire(changed)).value().opaque, 0.75);
    EXPECT_EQ(factorisation_from(plain).value().opaque, double{view::opaque_enough});
}

TEST(Bytes, OfEveryMessageAreReadBack) {
    for (const Message& example : all_examples()) {
        const std::vector<std::byte> head = encode_head(example);
        const Header header = parse_header(std::span(head).first<header_bytes>()).value();
        EXPECT_EQ(header.payload, example.payload_size());
        const Body body = parse_body(header, std::span(head).subspan(header_bytes)).value();
        EXPECT_EQ(body.index(), example.body.index());
        EXPECT_EQ(hex(encode_head({body, example.payload})), hex(head)) << name(body);
    }
}

// Of version 3, little-endian, whatever the machine: the fifth band of a frame. Of three rows the middle one
// is empty; the others begin with half of red, a quarter of green, all of blue, opaque, and the last has, far
// to the right, a level of alpha.
TEST(Bytes, OfSpans) {
    image::Window window{.face = 0, .rect = {256, 7, 300, 10}, .pixels = image::Image<image::RgbaF>(44, 3)};
    window.pixels.at(2, 0) = {0.5F, 0.25F, 1.0F, 1.0F};
    window.pixels.at(2, 2) = {0.5F, 0.25F, 1.0F, 1.0F};
    window.pixels.at(40, 2) = {0, 0, 0, 1.0F / 65535};
    const Message message = windows_message(3, 5, image::encode({&window, 1}));
    EXPECT_EQ(hex(*message.payload),
              "0100"
              "0201"
              "0100"
              "00800040ffffffff"
              "0000"
              "0200"
              "0201"
              "0100"
              "00800040ffffffff"
              "2801"
              "0100"
              "0000000000000100");
    EXPECT_EQ(hex(encode_head(message)).substr(40), "0803120c120a088404100e18d20420142805");
}

}  // namespace
}  // namespace shearwater::wire::test
