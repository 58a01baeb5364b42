// SPDX-License-Identifier: BSD-3-Clause
/// A view of contiguous elements, std::span's subset that C++17 can have.
#pragma once

#include <cstddef>
#include <type_traits>
#include <utility>

namespace gimdem::coupling
{

template <class T>
class Span
{
public:
    constexpr Span() = default;
    constexpr Span(T* data, std::size_t size) : data_(data), size_(size) {}

    /// From any container with data() and size(), e.g. std::vector.
    template <class Container,
              class = std::enable_if_t<std::is_convertible_v<decltype(std::declval<Container&>().data()), T*>>>
    constexpr Span(Container& container) : data_(container.data()), size_(container.size())
    {
    }

    constexpr T* data() const { return data_; }
    constexpr std::size_t size() const { return size_; }
    constexpr bool empty() const { return size_ == 0; }
    constexpr T& operator[](std::size_t i) const { return data_[i]; }
    constexpr T* begin() const { return data_; }
    constexpr T* end() const { return data_ + size_; }

private:
    T* data_ = nullptr;
    std::size_t size_ = 0;
};

}  // namespace gimdem::coupling
