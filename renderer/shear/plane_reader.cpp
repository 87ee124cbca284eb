#include "renderer/shear/plane_reader.h"

#include <algorithm>
#include <atomic>
#include <mutex>
#include <thread>

namespace shearwater::shear {

using volume::Box;

namespace {

// A chunk that stays in the processor's caches between reading and quantising.
constexpr std::size_t cached_bytes = std::size_t{1} << 20;

// A box cut into chunks of at most `room` voxels (one at the least): whole planes where they fit, else rows,
// else pieces of a row. Every voxel is in one of them.
std::vector<Box> chunks_of(const Box& box, std::int64_t room) {
    const std::int64_t row = box.planes(0);
    const std::int64_t length = std::clamp<std::int64_t>(room, 1, row);
    const std::int64_t rows = std::clamp<std::int64_t>(room / row, 1, box.planes(1));
    const std::int64_t planes = std::clamp<std::int64_t>(room / (row * box.planes(1)), 1, box.planes(2));
    std::vector<Box> chunks;
    for (std::int64_t z = box.lo[2]; z <= box.hi[2]; z += planes) {
        for (std::int64_t y = box.lo[1]; y <= box.hi[1]; y += rows) {
            for (std::int64_t x = box.lo[0]; x <= box.hi[0]; x += length) {
                chunks.push_back({{x, y, z},
                                  {std::min(x + length - 1, box.hi[0]), std::min(y + rows - 1, box.hi[1]),
                                   std::min(z + planes - 1, box.hi[2])}});
            }
        }
    }
    return chunks;
}

template <class Code>
void quantise_as(const volume::Quantiser& quantiser, std::span<const float> values, const Box& box,
                 CodeVolume& into) {
    const auto length = static_cast<std::size_t>(box.planes(0));
    for (std::int64_t z = box.lo[2]; z <= box.hi[2]; ++z) {
        for (std::int64_t y = box.lo[1]; y <= box.hi[1]; ++y) {
            quantiser.codes(values.first(length),
                            into.codes<Code>().subspan(into.offset({box.lo[0], y, z}), length));
            values = values.subspan(length);
        }
    }
}

}  // namespace

void quantise(const volume::Quantiser& quantiser, std::span<const float> values, const Box& box,
              CodeVolume& into) {
    into.bits() == 8 ? quantise_as<std::uint8_t>(quantiser, values, box, into)
                     : quantise_as<std::uint16_t>(quantiser, values, box, into);
}

PlaneReader::PlaneReader(volume::VoxelSource& source, const volume::Mapping& mapping, base::Workers& workers,
                         std::size_t slab_bytes)
    : source_(source),
      quantiser_(mapping),
      workers_(workers),
      slab_bytes_(slab_bytes),
      values_(static_cast<std::size_t>(source.concurrent() ? workers.threads() : 1)) {}

std::int64_t PlaneReader::planes_at_once(const Box& box) const {
    const auto room = static_cast<std::int64_t>(slab_bytes_ / sizeof(float));
    return std::clamp<std::int64_t>(room / (box.planes(0) * box.planes(1)), 1, box.planes(2));
}

base::Status PlaneReader::read(const Box& box, CodeVolume& into, const volume::Progress& progress,
                               const std::stop_token& stop) {
    const std::size_t readers = values_.size();
    const std::size_t bytes = readers > 1 ? std::min(slab_bytes_ / readers, cached_bytes) : slab_bytes_;
    const auto chunks = chunks_of(box, static_cast<std::int64_t>(bytes / sizeof(float)));
    const auto caller = std::this_thread::get_id();
    std::atomic<std::size_t> next{0}, done{0};
    std::mutex mutex;
    base::Status outcome;
    const auto work = [&](std::int64_t reader) {
        std::vector<float>& values = values_[static_cast<std::size_t>(reader)];
        values.resize(std::max(values.size(), static_cast<std::size_t>(chunks.front().voxels())));
        for (std::size_t i = next++; i < chunks.size() && !stop.stop_requested(); i = next++) {
            const auto part = std::span(values).first(static_cast<std::size_t>(chunks[i].voxels()));
            if (base::Status read = source_.read(chunks[i], part); !read) {
                next = chunks.size();
                const std::lock_guard lock(mutex);
                outcome = std::move(read);
                return;
            }
            quantise_chunk(part, chunks[i], into);
            const std::size_t ready = ++done;
            if (progress && std::this_thread::get_id() == caller) {
                progress(static_cast<double>(ready) / static_cast<double>(chunks.size()));
            }
        }
    };
    if (readers > 1) {
        workers_.for_each(static_cast<std::int64_t>(readers), work);
    } else {
        work(0);
    }
    if (outcome && done < chunks.size()) {
        return base::error(base::Code::cancelled, "read voxels " + volume::to_string(box), "stopped");
    }
    return outcome;
}

void PlaneReader::quantise_chunk(std::span<const float> values, const Box& chunk, CodeVolume& into) {
    if (source_.concurrent()) {
        quantise(quantiser_, values, chunk, into);
        return;
    }
    // The thread that reads hands out what it has read, plane by plane.
    const auto plane = static_cast<std::size_t>(chunk.planes(0) * chunk.planes(1));
    workers_.for_each(chunk.planes(2), [&](std::int64_t z) {
        Box slice = chunk;
        slice.lo[2] = slice.hi[2] = chunk.lo[2] + z;
        quantise(quantiser_, values.subspan(static_cast<std::size_t>(z) * plane, plane), slice, into);
    });
}

}  // namespace shearwater::shear
