// SPDX-License-Identifier: BSD-3-Clause
/// The first 512 bytes of a snapshot: what it is, and the checksum that its bytes must have.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace gimdem::output
{

/// Size of the seal: HDF5's smallest user block, which it skips.
inline constexpr std::size_t seal_size = 512;

/// The seal of `content`: lines of text, filled up with blanks.
///
///     gimdem snapshot 1
///     kind settled bed
///     size 1234567
///     xxh3 0123456789abcdef
///     seal 0123456789abcdef     checksum of the lines above
std::string make_seal(int version, std::string const& kind, std::span<std::byte const> content);

/// Throw UserError unless `bytes` are a seal of this version and kind followed by the content that it seals.
void check_seal(std::span<std::byte const> bytes, int version, std::string const& kind,
                std::filesystem::path const& file);

}  // namespace gimdem::output
