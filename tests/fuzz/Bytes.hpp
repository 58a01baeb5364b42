// SPDX-License-Identifier: BSD-3-Clause
/// The input of a fuzz target, read piece by piece; zeros once it is used up.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>

namespace gimdem::fuzz
{

class Bytes
{
public:
    Bytes(std::uint8_t const* data, std::size_t size) : at_(data), end_(data + size) {}

    bool empty() const { return at_ == end_; }
    std::size_t left() const { return static_cast<std::size_t>(end_ - at_); }

    std::uint8_t byte() { return at_ == end_ ? std::uint8_t{0} : *at_++; }
    /// 0 to count - 1.
    unsigned choose(unsigned count) { return byte() % count; }
    /// True for one byte in so many; never at the end of the input.
    bool once_in(unsigned count) { return byte() % count == count - 1; }

    template <class T>
    T raw()
    {
        T value{};
        std::size_t const size = std::min(sizeof(T), left());
        if (size > 0) std::memcpy(&value, at_, size);
        at_ += size;
        return value;
    }

    std::string text(std::size_t size)
    {
        size = std::min(size, left());
        std::string result(reinterpret_cast<char const*>(at_), size);
        at_ += size;
        return result;
    }
    std::string rest() { return text(left()); }

private:
    std::uint8_t const* at_;
    std::uint8_t const* end_;
};

}  // namespace gimdem::fuzz
