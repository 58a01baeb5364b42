// SPDX-License-Identifier: BSD-3-Clause
/// Memory of a device, and host memory that a device copies to and from quickly.
///
/// A Device (GuardedDevice, CudaDevice) is a queue: kernels and copies happen in the order in which they were asked
/// for, and the host sees a result only after wait(). It offers
///
///   void* allocate(bytes), free(p)            memory that kernels see and the host doesn't
///   void* allocate_pinned(bytes), free_pinned(p)   the other way round
///   copy_in(device, host, bytes), copy_out(host, device, bytes), copy(device, device, bytes), zero(device, bytes)
///   for_each(count, kernel)                   a trivially copyable functor over views, operator()(Index) const
///   fork(), for_each_beside(count, kernel), join()   kernels that may run at the same time as those asked for between
///                                             the same fork() and join(); they follow what was asked for before fork()
///   wait()                                    until everything asked for has happened
///   mark(), wait_for_mark()                   until everything asked for before the last mark() has happened
///   scan_by_library(...), sort_by_library(...)     false where plain kernels are to do it
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <type_traits>
#include <utility>

#include "exec/Buffer.hpp"
#include "exec/ForEach.hpp"

namespace gimdem::exec
{

/// Array in device memory. Grows only, so that a settled run allocates nothing; growing forgets what was in it.
template <class Device, class T>
class DeviceArray
{
    static_assert(std::is_trivially_copyable_v<T>);

public:
    DeviceArray() = default;
    DeviceArray(DeviceArray&& other) noexcept { swap(*this, other); }
    DeviceArray& operator=(DeviceArray&& other) noexcept
    {
        swap(*this, other);
        return *this;
    }
    ~DeviceArray()
    {
        if (data_ != nullptr) device_->free(data_);
    }

    void resize(Device& device, Index size)
    {
        if (size > capacity_)
        {
            if (data_ != nullptr) device_->free(std::exchange(data_, nullptr));
            device_ = &device;
            capacity_ = std::max(size, capacity_ + capacity_ / 2);
            data_ = static_cast<T*>(device.allocate(static_cast<std::size_t>(capacity_) * sizeof(T)));
        }
        size_ = size;
    }
    void upload(Device& device, std::span<T const> from)
    {
        resize(device, static_cast<Index>(from.size()));
        if (!from.empty()) device.copy_in(data_, from.data(), from.size_bytes());
    }
    void upload(Device& device, Buffer<T> const& from) { upload(device, from.host()); }
    /// The host may look after wait().
    void download(Device& device, Buffer<T>& to) const
    {
        to.resize(size_);
        if (size_ > 0) device.copy_out(to.view().data, data_, to.host().size_bytes());
    }
    void zero(Device& device)
    {
        if (size_ > 0) device.zero(data_, static_cast<std::size_t>(size_) * sizeof(T));
    }
    void copy(Device& device, DeviceArray const& from)
    {
        resize(device, from.size_);
        if (size_ > 0) device.copy(data_, from.data_, static_cast<std::size_t>(size_) * sizeof(T));
    }

    Index size() const { return size_; }
    T* data() const { return size_ > 0 ? data_ : nullptr; }
    View<T> view() const { return {data(), size_}; }
    friend void swap(DeviceArray& a, DeviceArray& b) noexcept
    {
        std::swap(a.device_, b.device_);
        std::swap(a.data_, b.data_);
        std::swap(a.size_, b.size_);
        std::swap(a.capacity_, b.capacity_);
    }

private:
    Device* device_ = nullptr;
    T* data_ = nullptr;
    Index size_ = 0;
    Index capacity_ = 0;
};

/// One value of device memory that the host asks for again and again.
template <class Device, class T>
class DeviceScalar
{
public:
    explicit DeviceScalar(Device& device) : device_(device), here_(static_cast<T*>(device.allocate_pinned(sizeof(T))))
    {
    }
    DeviceScalar(DeviceScalar const&) = delete;
    DeviceScalar& operator=(DeviceScalar const&) = delete;
    ~DeviceScalar() { device_.free_pinned(here_); }

    /// Waits for everything asked for so far.
    T read(T const* there)
    {
        device_.copy_out(here_, there, sizeof(T));
        device_.wait();
        return *here_;
    }

    /// The same in two parts, between which more can be asked for; one question at a time on a device.
    void ask(T const* there)
    {
        device_.copy_out(here_, there, sizeof(T));
        device_.mark();
    }
    T answer()
    {
        device_.wait_for_mark();
        return *here_;
    }

private:
    Device& device_;
    T* here_;
};

}  // namespace gimdem::exec
