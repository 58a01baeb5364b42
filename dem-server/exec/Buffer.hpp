// SPDX-License-Identifier: BSD-3-Clause
/// Memory that kernels work on. Stages own Buffers; kernels see View: a pointer and a length.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <new>
#include <span>
#include <type_traits>

#include "exec/HostDevice.hpp"

namespace gimdem::exec
{

/// What a kernel sees of a Buffer.
template <class T>
struct View
{
    T* data = nullptr;
    std::int64_t size = 0;

    GIMDEM_HD T& operator[](std::int64_t i) const { return data[i]; }
};

/// Growing array of trivially copyable elements on cache-line boundaries. resize() keeps the old elements and leaves
/// new ones uninitialised; capacity only grows, so a settled run allocates nothing.
template <class T>
class Buffer
{
    static_assert(std::is_trivially_copyable_v<T>);

public:
    Buffer() = default;
    explicit Buffer(std::int64_t size) { resize(size); }
    Buffer(Buffer const& other) { *this = other; }
    Buffer(Buffer&&) noexcept = default;
    Buffer& operator=(Buffer&&) noexcept = default;
    ~Buffer() = default;
    Buffer& operator=(Buffer const& other)
    {
        if (this == &other) return *this;
        resize(other.size_);
        std::copy_n(other.data_.get(), other.size_, data_.get());
        return *this;
    }

    void resize(std::int64_t size)
    {
        if (size > capacity_) grow(size);
        size_ = size;
    }
    void fill(T const& value) { std::fill_n(data_.get(), size_, value); }

    std::int64_t size() const { return size_; }
    View<T> view() { return {data_.get(), size_}; }
    View<T const> view() const { return {data_.get(), size_}; }
    std::span<T> host() { return {data_.get(), static_cast<std::size_t>(size_)}; }
    std::span<T const> host() const { return {data_.get(), static_cast<std::size_t>(size_)}; }
    T& operator[](std::int64_t i) { return data_.get()[i]; }
    T const& operator[](std::int64_t i) const { return data_.get()[i]; }
    friend void swap(Buffer& a, Buffer& b) noexcept
    {
        std::swap(a.data_, b.data_);
        std::swap(a.size_, b.size_);
        std::swap(a.capacity_, b.capacity_);
    }

private:
    struct Free
    {
        void operator()(T* p) const { std::free(p); }
    };

    void grow(std::int64_t size)
    {
        constexpr std::size_t line = 64;
        std::int64_t const capacity = std::max(size, capacity_ + capacity_ / 8);
        std::size_t const bytes = (static_cast<std::size_t>(capacity) * sizeof(T) + line - 1) / line * line;
        std::unique_ptr<T, Free> grown(static_cast<T*>(std::aligned_alloc(line, bytes)));
        if (!grown) throw std::bad_alloc();
        if (capacity_ > 0) std::memcpy(grown.get(), data_.get(), static_cast<std::size_t>(size_) * sizeof(T));
        data_ = std::move(grown);
        capacity_ = capacity;
    }

    std::unique_ptr<T, Free> data_;
    std::int64_t size_ = 0;
    std::int64_t capacity_ = 0;
};

}  // namespace gimdem::exec
