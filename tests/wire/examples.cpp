#include "tests/wire/examples.h"

#include "protocol/wire/convert_look.h"

namespace shearwater::wire::test {
namespace {

std::vector<std::byte> bytes(std::initializer_list<int> values) {
    std::vector<std::byte> result;
    for (const int value : values) {
        result.push_back(static_cast<std::byte>(value));
    }
    return result;
}

const volume::Box box{{0, 1, 2}, {64, 65, 300}};
const view::Lattice lattice{{64, 100, 301}, {1, 2, 0.5}};
const volume::Mapping mapping{-1.5, 2.5, volume::Stretch::asinh, 16};

template <class T>
void fill(T& to, const T& from) {
    to = from;
}

pb::Missing missing() {
    pb::Missing m;
    m.set_place(3);
    fill(*m.mutable_box(), to_wire(box));
    return m;
}

pb::LeafStats leaf_stats() {
    pb::LeafStats s;
    s.set_render_seconds(0.25);
    s.set_composite_seconds(0.125);
    s.set_samples(1000000);
    s.set_bricks_total(512);
    s.set_bricks_empty(100);
    s.set_bricks_rendered(412);
    s.set_window_bytes(std::uint64_t{1} << 33);
    return s;
}

pb::Challenge challenge() {
    pb::Challenge m;
    m.set_version_min(1);
    m.set_version_max(2);
    m.set_nonce("0123456789abcdef");
    return m;
}
pb::Hello hello() {
    pb::Hello m;
    m.set_role(pb::ROLE_CHILD);
    m.set_version_min(1);
    m.set_version_max(2);
    m.set_nonce("fedcba9876543210");
    m.set_proof("not a real proof");
    m.set_name("node7/42");
    return m;
}
pb::Welcome welcome() {
    pb::Welcome m;
    m.set_version(1);
    m.set_proof("nor is this");
    return m;
}
pb::Goodbye goodbye() {
    pb::Goodbye m;
    m.set_reason(pb::REASON_REPLACED);
    m.set_text("another came");
    return m;
}
pb::Ping ping() {
    pb::Ping m;
    m.set_token(300);
    return m;
}
pb::Pong pong() {
    pb::Pong m;
    m.set_token(300);
    return m;
}

pb::Join join() {
    pb::Join m;
    m.set_role(pb::ROLE_COMPOSITOR);
    m.set_listen_host("10.0.0.7");
    m.set_listen_port(9100);
    m.set_threads(8);
    m.set_node_name("left");
    return m;
}
pb::Assign assign() {
    pb::Assign m;
    m.set_epoch(12345678901);
    m.set_place(2);
    fill(*m.mutable_box(), to_wire(box));
    m.set_parent_host("10.0.0.1");
    m.set_parent_port(9000);
    pb::Child& child = *m.add_children();
    child.set_place(5);
    fill(*child.mutable_box(), to_wire(box));
    pb::CubeSource& cube = *m.mutable_cube();
    cube.set_path("/data/cube.fits");
    cube.set_hdu(1);
    cube.set_plane(-1);
    fill(*cube.mutable_lattice(), to_wire(lattice));
    fill(*m.mutable_mapping(), to_wire(mapping));
    m.set_bits(16);
    return m;
}
pb::Report report() {
    pb::Report m;
    m.set_place(2);
    m.set_phase(pb::PHASE_FAILED);
    m.set_fraction(0.5);
    m.set_memory_bytes(1 << 20);
    m.set_peak_bytes(1 << 21);
    m.set_error("no such file");
    m.set_parent_lost(true);
    return m;
}

pb::Adopt adopt() {
    pb::Adopt m;
    m.set_epoch(12345678901);
    m.set_place(2);
    return m;
}
pb::HistogramReport histogram_report() {
    pb::HistogramReport m;
    m.add_places(3);
    m.add_places(4);
    m.add_key_steps(524288);
    m.add_key_steps(1);
    m.add_counts(7);
    m.add_counts(1000);
    m.set_blank(2);
    m.set_min(0.5);
    m.set_max(1.5);
    return m;
}
pb::SetMapping set_mapping() {
    pb::SetMapping m;
    fill(*m.mutable_mapping(), to_wire(mapping));
    return m;
}
pb::NeedVoxels need_voxels() {
    pb::NeedVoxels m;
    m.set_place(3);
    m.set_request(9);
    fill(*m.mutable_box(), to_wire(box));
    return m;
}
pb::Voxels voxels() {
    pb::Voxels m;
    m.set_place(3);
    m.set_request(9);
    fill(*m.mutable_box(), to_wire(box));
    m.set_error("gone");
    return m;
}
pb::Render render() {
    pb::Render m;
    m.set_frame(17);
    fill(*m.mutable_factorisation(), to_wire(factorisation()));
    fill(*m.mutable_transfer_function(), to_wire(transfer_function()));
    return m;
}
pb::Cancel cancel() {
    pb::Cancel m;
    m.set_frame(17);
    return m;
}
pb::Windows windows() {
    pb::Windows m;
    m.set_frame(17);
    pb::WindowHead& head = *m.add_windows();
    head.set_face(1);
    fill(*head.mutable_rect(), to_wire(view::Rect{1, 0, 2, 1}));
    fill(*m.add_missing(), missing());
    fill(*m.mutable_stats(), leaf_stats());
    return m;
}

pb::WantFunctions want_functions() {
    pb::WantFunctions m;
    pb::FunctionWant& want = *m.add_wants();
    want.set_number(6);
    fill(*want.mutable_key(), to_wire(function_key()));
    want.add_known(3);
    m.set_block_edge(32);
    m.set_side(36);
    m.set_renewal(1);
    return m;
}
pb::Functions functions() {
    pb::Functions m;
    m.set_number(6);
    m.set_place(3);
    m.set_coarse(true);
    fill(*m.mutable_blocks(), to_wire(volume::Box{{0, 0, 0}, {2, 1, 1}}));
    m.set_side(4);
    m.set_first_direction(6);
    m.set_directions(2);
    return m;
}

pb::GiveFunctions give_functions() {
    pb::GiveFunctions m;
    m.set_request(21);
    fill(*m.mutable_key(), to_wire(function_key()));
    fill(*m.mutable_functions(), functions());
    return m;
}
pb::Look look() {
    return to_wire(LookRequest{.request = 22,
                               .factorisation = factorisation(),
                               .tf = transfer_function(),
                               .settings = {culling::Kind::opof, 0.95},
                               .functions = {6, 7},
                               .places = {3, 4, 6}});
}
pb::Replied replied() {
    return to_wire(Reply{22, true, std::string("\x05\x80\x00", 3)});
}

pb::CubeDescription cube_description() {
    pb::CubeDescription m;
    m.set_name("cube.fits");
    m.set_object("NGC 6946");
    m.set_unit("JY/BEAM");
    fill(*m.mutable_lattice(), to_wire(lattice));
    fill(*m.mutable_mapping(), to_wire(mapping));
    return m;
}
pb::TreeState tree_state() {
    pb::TreeState m;
    pb::Node& node = *m.add_nodes();
    node.set_place(1);
    node.set_parent(-1);
    node.set_role(pb::ROLE_RENDERER);
    node.set_name("node7");
    fill(*node.mutable_box(), to_wire(box));
    node.set_phase(pb::PHASE_READY);
    node.set_fraction(1);
    node.set_memory_bytes(1 << 20);
    node.set_peak_bytes(1 << 21);
    node.set_error("none");
    m.set_ready(true);
    return m;
}
pb::Frame frame() {
    pb::Frame m;
    m.set_number(18);
    m.set_revision(5);
    m.set_width(640);
    m.set_height(480);
    m.set_encoding(pb::ENCODING_RLE_DEFLATE);
    fill(*m.add_missing(), missing());
    fill(*m.mutable_stats()->mutable_leaves(), leaf_stats());
    m.mutable_stats()->set_warp_seconds(0.5);
    m.mutable_stats()->set_encode_seconds(0.25);
    m.mutable_stats()->set_total_seconds(1);
    return m;
}
pb::FrameShown frame_shown() {
    pb::FrameShown m;
    m.set_number(18);
    return m;
}

pb::Pick pick() {
    return to_wire(pick_request());
}
pb::Picked picked() {
    return to_wire(PickAnswer{
        .revision = 9, .hit = view::RayHit{{1.5, 2, 3.25}, 0.75}, .value = -0.5, .incomplete = true});
}
pb::Probe probe() {
    pb::Probe m;
    m.set_number(19);
    view::Factorisation ray = factorisation();
    ray.slice_exponent = -1;
    ray.faces = {{.axis = 2, .sign = 1, .width = 1, .height = 1, .origin = {-0.5, -0.25}, .pitch = {1, 1}}};
    fill(*m.mutable_factorisation(), to_wire(ray));
    fill(*m.mutable_transfer_function(), to_wire(transfer_function()));
    return m;
}
pb::Probed probed() {
    return to_wire(RayPart{.number = 19, .samples = {{7, 0.5F}, {6, 0.25F}, {3, 2}}, .incomplete = true});
}

}  // namespace

PickRequest pick_request() {
    const View view = view_request();
    return {.revision = 9, .camera = view.camera, .size = view.size, .at = {320.5, 7.5}, .tf = view.tf};
}

std::vector<Message> examples() {
    return {message(challenge()),
            message(hello()),
            message(welcome()),
            message(goodbye()),
            message(ping()),
            message(pong()),
            message(join()),
            message(assign()),
            message(report()),
            message(adopt()),
            message(histogram_report()),
            message(set_mapping()),
            message(need_voxels()),
            message(voxels(), bytes({0, 0, 128, 63})),
            message(render()),
            message(cancel()),
            message(windows(), bytes({1, 0, 2, 0, 3, 0, 255, 255})),
            message(want_functions()),
            message(functions(), bytes({1, 2, 3, 4})),
            message(cube_description()),
            message(tree_state()),
            message(to_wire(view_request())),
            message(frame(), bytes({9, 8, 7})),
            message(frame_shown()),
            message(pick()),
            message(picked()),
            message(probe()),
            message(probed()),
            message(give_functions(), bytes({1, 2, 3, 4})),
            message(look()),
            message(replied())};
}

std::vector<Message> sketch_examples() {
    pb::Assign first = assign();
    first.set_sketch_level(3);
    pb::HistogramReport report = histogram_report();
    report.set_sketch(true);
    pb::Render drawn = render();
    fill(*drawn.mutable_sketch(), to_wire(mapping));
    pb::CubeDescription described = cube_description();
    described.set_provisional(true);
    View view = view_request();
    view.sketch = true;
    pb::Frame shown = frame();
    shown.set_sketch(true);
    return {message(first),     message(report),        message(drawn),
            message(described), message(to_wire(view)), message(shown, bytes({9, 8, 7}))};
}

std::vector<Message> culling_examples() {
    pb::Render drawn = render();
    drawn.set_block_edge(32);
    drawn.set_visible("\x03");
    pb::Windows cost = windows();
    cost.mutable_stats()->set_bricks_culled(5);
    View view = view_request();
    view.culling = {culling::Kind::opof, 0.75};
    return {message(drawn), message(cost, bytes({1, 0, 2, 0, 3, 0, 255, 255})), message(to_wire(view))};
}

std::vector<Message> editor_examples() {
    pb::CubeDescription described = cube_description();
    *described.mutable_values() = to_wire(summary());
    View view = view_request();
    view.tf.density = 2;
    std::get<view::Hat>(view.tf.opacity_pins[1]).lean = 0.0625;
    return {message(described), message(to_wire(view))};
}

std::vector<Message> stereo_examples() {
    View view = view_request();
    view.stereo = view::StereoSettings{1, 2, true};
    view.crop = volume::Box{{1, 2, 3}, {40, 50, 60}};
    view.camera.slant = {0.25, -0.5};
    view::Factorisation cropped = factorisation();
    cropped.crop = view.crop;
    pb::Render drawn = render();
    fill(*drawn.mutable_factorisation(), to_wire(cropped));
    pb::Frame pair = frame();
    pair.set_eyes(2);
    return {message(to_wire(view)), message(drawn), message(pair, bytes({9, 8, 7}))};
}

std::vector<Message> world_examples() {
    pb::CubeDescription described = cube_description();
    put(world_axes(), *described.mutable_axes());
    return {message(described)};
}

std::vector<Message> all_examples() {
    std::vector<Message> all = examples();
    for (Message& message : editor_examples()) {
        all.push_back(std::move(message));
    }
    for (Message& message : stereo_examples()) {
        all.push_back(std::move(message));
    }
    for (Message& message : world_examples()) {
        all.push_back(std::move(message));
    }
    for (Message& message : culling_examples()) {
        all.push_back(std::move(message));
    }
    for (Message& message : sketch_examples()) {
        all.push_back(std::move(message));
    }
    return all;
}

view::TransferFunction transfer_function() {
    view::TransferFunction tf;
    tf.opacity_pins = {view::Ramp{0.25, 0, 1, 0.5}, view::Hat{0.5, 0.125, 0.25, 0.75}, view::Flat{0.0625},
                       view::Blank{0.25, 0.375}};
    tf.colour_pins = {{0, {0, 0, 0}}, {0.5, {1, 0.5, 0.25}}, {1, {1, 1, 1}}};
    tf.background = {0.125, 0.25, 0.5};
    return tf;
}

view::Factorisation factorisation() {
    view::Factorisation f;
    f.projection = view::Projection::perspective;
    f.lattice = lattice;
    f.eye = {10, 20, -500};
    f.direction = {0, 0, 1};
    f.faces = {
        {.axis = 2, .sign = 1, .width = 5, .height = 4, .origin = {-0.5, -0.25}, .pitch = {0.25, 0.125}},
        {.axis = 0, .sign = -1, .width = 3, .height = 2, .origin = {0.5, -1}, .pitch = {0.5, 0.5}}};
    return f;
}

volume::Summary summary() {
    volume::Summary s{.counts = {1, 300},
                      .below = 2,
                      .above = 3,
                      .blank = 4,
                      .min = -2,
                      .max = 4,
                      .median = 0.5,
                      .sigma = 0.25,
                      .quantiles = {}};
    for (std::size_t i = 0; i < volume::Summary::quantile_count; ++i) {
        s.quantiles.push_back(-2 + 6 * volume::Summary::share_of(i));
    }
    return s;
}

wcs::Axes world_axes() {
    return {wcs::Axis{.name = "right ascension",
                      .label = "RA",
                      .unit = "deg",
                      .notation = wcs::Notation::hours,
                      .circle = true,
                      .nodes = {3, 2, 1},
                      .values = {1, 0.5, 0, 1.25, 0.5, 359.75}},
            {.name = "declination",
             .label = "Dec",
             .unit = "deg",
             .notation = wcs::Notation::degrees,
             .nodes = {1, 2, 1},
             .values = {-30, -29.5}},
            {.name = "radio velocity",
             .label = "Vel",
             .unit = "km/s",
             .nodes = {1, 1, 2},
             .values = {-100, 100}}};
}

culling::FunctionKey function_key() {
    return {.footprint = culling::Footprint::column,
            .basis = {.shape = view::Hat{0.5, 0.125, 0.25, 1}, .blanks = {{0.25, 0.375}}},
            .level = 1};
}

View view_request() {
    View v;
    v.revision = 5;
    v.camera = {.eye = {1, 2, 3},
                .target = {0.5, 0, 0},
                .up = {0, 1, 0},
                .projection = view::Projection::parallel,
                .fov = 30,
                .height = 100};
    v.size = {640, 480};
    v.tf = transfer_function();
    v.quality = view::Quality::high;
    v.deflate = true;
    return v;
}

}  // namespace shearwater::wire::test
