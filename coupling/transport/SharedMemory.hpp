// SPDX-License-Identifier: BSD-3-Clause
/// One segment of POSIX shared memory, seen from the side that writes it and from the side that reads it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>

namespace gimdem::coupling::transport
{

/// What the writer of a segment tells its reader.
struct SegmentNotice
{
    std::string name;         ///< "/gimdem-<process>-<32 hexadecimal digits>"
    std::uint64_t bytes = 0;  ///< size

    bool empty() const { return name.empty() && bytes == 0; }
};

/// The largest segment that is made or mapped [byte]; cells beyond it (30 million or so) go as plain frames.
inline constexpr std::uint64_t max_segment_bytes = std::uint64_t{16} << 30;

/// Bytes of this process that are mapped until destruction.
class Mapping
{
public:
    Mapping(void* data, std::size_t bytes) : data_(static_cast<unsigned char*>(data)), bytes_(bytes) {}
    ~Mapping();
    Mapping(Mapping const&) = delete;
    Mapping& operator=(Mapping const&) = delete;

    unsigned char* data() const { return data_; }
    std::size_t bytes() const { return bytes_; }

private:
    unsigned char* data_;
    std::size_t bytes_;
};

/// A segment that we write. Its name disappears as soon as the reader has mapped it, at the latest with this object;
/// the memory itself lives as long as somebody maps it.
class OwnSegment
{
public:
    OwnSegment(SegmentNotice notice, void* data) : notice_(std::move(notice)), memory_(data, notice_.bytes) {}
    ~OwnSegment() { remove_name(); }
    OwnSegment(OwnSegment const&) = delete;
    OwnSegment& operator=(OwnSegment const&) = delete;

    SegmentNotice const& notice() const { return notice_; }
    Mapping const& memory() const { return memory_; }
    void remove_name() noexcept;

private:
    SegmentNotice notice_;
    Mapping memory_;
};

/// A segment, or why there is none.
template <class Segment>
struct Attempt
{
    std::shared_ptr<Segment> segment;
    std::string obstacle;  ///< in words; empty if there is a segment
};

/// A segment of so many bytes, all of them reserved: writing it can never fail for want of memory.
Attempt<OwnSegment> make_segment(std::uint64_t bytes);

/// Maps a peer's segment for reading, and removes its name. There may be an obstacle (the peer sees other memory than
/// we do, or belongs to another user); a notice that cannot be true is Fault::protocol.
Attempt<Mapping const> map_segment(SegmentNotice const& notice);

}  // namespace gimdem::coupling::transport
