// SPDX-License-Identifier: BSD-3-Clause
#include "message/Compression.hpp"

#include <lz4.h>

#include "message/Arrays.hpp"

namespace gimdem::coupling::message
{

void shuffle_bytes(unsigned char const* from, std::size_t count, std::size_t size, unsigned char* to)
{
    for (std::size_t b = 0; b < size; ++b)
        for (std::size_t i = 0; i < count; ++i)
            to[b * count + i] = from[i * size + b];
}

void unshuffle_bytes(unsigned char const* from, std::size_t count, std::size_t size, unsigned char* to)
{
    for (std::size_t i = 0; i < count; ++i)
        for (std::size_t b = 0; b < size; ++b)
            to[i * size + b] = from[b * count + i];
}

transport::Frame compress(transport::Frame const& numbers, std::size_t number_bytes)
{
    if (numbers.size() < 2 * number_bytes || numbers.size() > LZ4_MAX_INPUT_SIZE) return {};
    std::vector<unsigned char> shuffled(numbers.size()), packed(numbers.size() - 1);
    shuffle_bytes(static_cast<unsigned char const*>(numbers.data()), numbers.size() / number_bytes, number_bytes,
                  shuffled.data());
    int const bytes =
        LZ4_compress_default(reinterpret_cast<char const*>(shuffled.data()), reinterpret_cast<char*>(packed.data()),
                             static_cast<int>(shuffled.size()), static_cast<int>(packed.size()));
    return bytes > 0 ? transport::Frame(packed.data(), static_cast<std::size_t>(bytes)) : transport::Frame();
}

void decompress(v1::ArrayHeader const& header, transport::Frame const& frame, std::vector<unsigned char>& to)
{
    std::string const who = "array \"" + header.name() + "\"";
    std::size_t const size = element_size(header.type());
    std::size_t const count = header.count() * header.components();
    if (header.compression() != v1::COMPRESSION_SHUFFLED_LZ4) refuse(who + " has an unknown compression");
    if (count > LZ4_MAX_INPUT_SIZE / size || frame.size() > LZ4_MAX_INPUT_SIZE)
        refuse(who + " is compressed and has " + std::to_string(count) + " numbers (at most " +
               std::to_string(LZ4_MAX_INPUT_SIZE / size) + ")");
    std::vector<unsigned char> shuffled(count * size);
    to.resize(count * size);
    int const bytes =
        LZ4_decompress_safe(static_cast<char const*>(frame.data()), reinterpret_cast<char*>(shuffled.data()),
                            static_cast<int>(frame.size()), static_cast<int>(shuffled.size()));
    if (bytes < 0 || static_cast<std::size_t>(bytes) != shuffled.size())
        refuse(who + " cannot be decompressed to the " + std::to_string(shuffled.size()) +
               " bytes that its header promises (a truncated or corrupted frame)");
    unshuffle_bytes(shuffled.data(), count, size, to.data());
}

}  // namespace gimdem::coupling::message
