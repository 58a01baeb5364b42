// SPDX-License-Identifier: BSD-3-Clause
/// HDF5's C interface with handles that close themselves. Only sources that store snapshots include this.
#pragma once

#include <hdf5.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace gimdem::output::hdf5
{

/// An identifier of HDF5 and the function that gives it back.
class Handle
{
public:
    using Close = herr_t (*)(hid_t);

    /// Throws std::runtime_error naming `what` where `id` is none.
    Handle(hid_t id, Close close, std::string const& what) : id_(id), close_(close)
    {
        if (id_ < 0) throw std::runtime_error("HDF5 fails at " + what);
    }
    ~Handle()
    {
        if (id_ >= 0) close_(id_);
    }
    Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
    Handle& operator=(Handle&&) = delete;

    hid_t get() const { return id_; }

private:
    hid_t id_;
    Close close_;
};

/// Keeps HDF5 from printing; failures become exceptions.
class Silence
{
public:
    Silence();
    ~Silence();
    Silence(Silence const&) = delete;
    Silence& operator=(Silence const&) = delete;

private:
    H5E_auto2_t function_ = nullptr;
    void* data_ = nullptr;
};

/// An empty file in memory; nothing reaches the disk.
Handle create_in_memory();

/// The file of `image` in memory, for reading.
Handle open_in_memory(std::span<std::byte const> image);

/// The bytes of a file.
std::vector<std::byte> image_of(Handle const& file);

/// How a C++ type is called in memory and in a file, which is little-endian everywhere.
template <class T>
struct Type;

template <>
struct Type<double>
{
    static hid_t memory() { return H5T_NATIVE_DOUBLE; }
    static hid_t file() { return H5T_IEEE_F64LE; }
};

template <>
struct Type<std::int64_t>
{
    static hid_t memory() { return H5T_NATIVE_INT64; }
    static hid_t file() { return H5T_STD_I64LE; }
};

template <>
struct Type<std::int32_t>
{
    static hid_t memory() { return H5T_NATIVE_INT32; }
    static hid_t file() { return H5T_STD_I32LE; }
};

/// Throw std::runtime_error naming `what` where HDF5 reports failure.
inline void check(herr_t status, std::string const& what)
{
    if (status < 0) throw std::runtime_error("HDF5 fails at " + what);
}

/// A dataspace of these sizes; none: a single value.
Handle make_space(std::vector<hsize_t> const& sizes);

/// Sizes of a dataset or attribute.
std::vector<hsize_t> sizes_of(Handle const& space);

}  // namespace gimdem::output::hdf5
