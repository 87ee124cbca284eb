#pragma once
// What a header says its HDU is, as far as that can be true of the file it stands in.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/base/result.h"
#include "common/fits/bytes.h"
#include "common/fits/encoding.h"
#include "common/fits/header.h"

namespace shearwater::fits {

enum class HduKind { image, compressed_image, random_groups, table, other };

struct Hdu {
    int number = 0;  // 0 is the primary
    HduKind kind = HduKind::other;
    Header header;
    int bitpix = 0;                  // of the pixels: of the uncompressed ones where they are compressed
    std::vector<std::int64_t> axes;  // lengths of axis 1, 2, ...; of an image only
    std::int64_t data_bytes = 0;     // as the header has it, without padding
    std::int64_t next_offset = 0;    // where the next HDU would begin

    bool is_image() const { return kind == HduKind::image || kind == HduKind::compressed_image; }
    int long_axes() const;      // how many are longer than 1; 0 where one has no length at all
    std::string shape() const;  // "100 x 100 x 101"
};

// The HDU whose header begins at `offset`. An error where the header contradicts itself, so that what
// comes after cannot be found either; unset where no further HDU begins there.
base::Result<std::optional<Hdu>> read_hdu(const Bytes& bytes, std::int64_t offset, int number,
                                          const std::string& operation);

// Whether the file holds all data that an HDU claims: the error names what is missing.
base::Status check_present(const Hdu& hdu, const Bytes& bytes, const std::string& operation);

// How an image stores its values. Refuses a header with more than one shape of it; scaling that cannot be
// used is left out, with a note.
base::Result<Encoding> read_encoding(const Hdu& hdu, const std::string& operation,
                                     std::vector<std::string>& notes);

}  // namespace shearwater::fits
