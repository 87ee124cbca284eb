#pragma once
// Between the schema's values and ours. What comes from a peer is validated here, so that nothing else
// has to: a Fault names the field.

#include <optional>
#include <vector>

#include "common/culling/settings.h"
#include "common/image/image.h"
#include "common/image/over_windows.h"
#include "common/view/bands.h"
#include "common/view/camera.h"
#include "common/view/factorisation.h"
#include "common/view/stereo.h"
#include "common/view/transfer_function.h"
#include "common/volume/box.h"
#include "common/volume/histogram.h"
#include "common/volume/mapping.h"
#include "common/volume/summary.h"
#include "protocol/wire/header.h"

namespace shearwater::wire {

pb::Box to_wire(const volume::Box& box);
pb::Rect to_wire(const view::Rect& rect);
pb::Lattice to_wire(const view::Lattice& lattice);
pb::Mapping to_wire(const volume::Mapping& mapping);
pb::Scaling to_wire(const volume::Scaling& scaling);
pb::Camera to_wire(const view::Camera& camera);
pb::TransferFunction to_wire(const view::TransferFunction& tf);
pb::Factorisation to_wire(const view::Factorisation& factorisation);
pb::HistogramReport to_wire(const volume::Histogram& histogram);
pb::ValueSummary to_wire(const volume::Summary& summary);
pb::Quality to_wire(view::Quality quality);

Parsed<volume::Box> box_from(const pb::Box& box);  // lo <= hi, indices within 2^40
Parsed<view::Lattice> lattice_from(const pb::Lattice& lattice);
Parsed<volume::Mapping> mapping_from(const pb::Mapping& mapping);
Parsed<volume::Scaling> scaling_from(const pb::Scaling& scaling);
Parsed<view::TransferFunction> transfer_function_from(const pb::TransferFunction& tf);
Parsed<view::Factorisation> factorisation_from(const pb::Factorisation& factorisation);
Parsed<volume::Histogram> histogram_from(const pb::HistogramReport& report);
Parsed<volume::Summary> summary_from(const pb::ValueSummary& summary);

// A client's request, whole: camera and size are valid together.
struct View {
    std::uint64_t revision = 0;
    view::Camera camera;
    view::ImageSize size;
    view::TransferFunction tf;
    view::Quality quality = view::Quality::normal;
    bool deflate = false;
    std::optional<bool> level_of_detail;  // else as the server has it
    bool sketch = false;                  // before the cube is loaded, pictures of a sketch are welcome
    view::Classify classify = view::Classify::post;
    culling::Settings culling;
    std::optional<view::StereoSettings> stereo;  // a pair of pictures, for two eyes
    std::optional<volume::Box> crop;             // of whatever cube there is: only its order is checked
    std::optional<volume::Scaling> scaling;      // of the cube's values; else the server's own
};
// Of the one picture, or of the left eye's and the right one's.
std::vector<view::Camera> cameras_of(const View& view);
pb::SetView to_wire(const View& view);
Parsed<View> view_from(const pb::SetView& view);

// What a message adds to the bands of a frame that are known already: all up to `bands` are now, and the last
// of them has the window. That has no pixels where there is nothing.
struct BandWindow {
    std::size_t bands = 0;
    image::SpanWindow window;
};
// With the window, or none, of the last of the bands: its head in the body, its spans the payload.
Message windows_message(std::uint64_t frame, std::size_t bands, image::CodedWindows windows);
Message windows_message(std::uint64_t frame, const BandWindow& band, Payload payload);
// The window views the message's payload. It keeps to its band, its spans to its rectangle, and the payload
// holds nothing else. At least one of the frame's `all` bands is new, and what a frame lacks and what it cost
// comes with the last one.
Parsed<BandWindow> windows_from(const Message& message, std::span<const view::Band> all, std::size_t known);

}  // namespace shearwater::wire
