// SPDX-License-Identifier: BSD-3-Clause
#include <cerrno>
#include <cstring>
#include <fstream>

#include "core/Error.hpp"
#include "output/Hdf5.hpp"
#include "output/Snapshot.hpp"
#include "output/SnapshotSeal.hpp"

namespace gimdem::output
{

using hdf5::Handle;

namespace
{

std::vector<std::byte> read_file(std::filesystem::path const& file)
{
    std::error_code error;
    auto const size = std::filesystem::file_size(file, error);
    if (error)
        throw UserError("snapshot " + file.string() + " cannot be read (" + error.message() + "); check the path");
    std::vector<std::byte> bytes(size);
    std::ifstream in(file, std::ios::binary);
    if (!in.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size)))
        throw UserError("snapshot " + file.string() + " cannot be read (" + std::strerror(errno) + "); check the path");
    return bytes;
}

/// The HDF5 file behind an intact seal.
Handle open_checked(std::filesystem::path const& file, std::string const& kind)
{
    auto const bytes = read_file(file);
    check_seal(bytes, snapshot_version, kind, file);
    return hdf5::open_in_memory(std::span(bytes).subspan(seal_size));
}

}  // namespace

struct SnapshotReader::Image
{
    Image(std::filesystem::path const& place, std::string const& kind) : path(place), file(open_checked(place, kind)) {}

    // both HDF5 functions are negative where a group on the way is absent
    bool has_array(std::string const& name) const { return H5Lexists(file.get(), name.c_str(), H5P_DEFAULT) > 0; }
    bool has_value(std::string const& name) const { return H5Aexists(file.get(), name.c_str()) > 0; }
    Handle array(std::string const& name) const;
    Handle value(std::string const& name) const;
    [[noreturn]] void fail(std::string const& problem) const;

    template <class T>
    std::vector<T> read_array(std::string const& name) const;

    template <class T>
    T read_value(std::string const& name) const;

    hdf5::Silence silence;
    std::filesystem::path path;
    Handle file;
};

void SnapshotReader::Image::fail(std::string const& problem) const
{
    throw UserError("snapshot " + path.string() + ' ' + problem +
                    " (another program or case wrote it); remove it, so "
                    "that it is made again");
}

Handle SnapshotReader::Image::array(std::string const& name) const
{
    if (!has_array(name)) fail("has no array \"" + name + '"');
    return {H5Dopen2(file.get(), name.c_str(), H5P_DEFAULT), H5Dclose, "array " + name};
}

Handle SnapshotReader::Image::value(std::string const& name) const
{
    if (!has_value(name)) fail("has no value \"" + name + '"');
    return {H5Aopen(file.get(), name.c_str(), H5P_DEFAULT), H5Aclose, "value " + name};
}

template <class T>
std::vector<T> SnapshotReader::Image::read_array(std::string const& name) const
{
    Handle const data = array(name);
    Handle const type(H5Dget_type(data.get()), H5Tclose, "type of " + name);
    if (H5Tequal(type.get(), hdf5::Type<T>::file()) <= 0) fail("has an array \"" + name + "\" of another type");
    Handle const space(H5Dget_space(data.get()), H5Sclose, "size of " + name);
    std::size_t count = 1;
    for (auto const size : hdf5::sizes_of(space))
        count *= size;
    std::vector<T> values(count);
    hdf5::check(H5Dread(data.get(), hdf5::Type<T>::memory(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()),
                "array " + name);
    return values;
}

template <class T>
T SnapshotReader::Image::read_value(std::string const& name) const
{
    Handle const attribute = value(name);
    Handle const type(H5Aget_type(attribute.get()), H5Tclose, "type of " + name);
    if (H5Tequal(type.get(), hdf5::Type<T>::file()) <= 0) fail("has a value \"" + name + "\" of another type");
    T value{};
    hdf5::check(H5Aread(attribute.get(), hdf5::Type<T>::memory(), &value), "value " + name);
    return value;
}

SnapshotReader::SnapshotReader(std::filesystem::path const& file, std::string const& kind)
    : image_(std::make_unique<Image const>(file, kind))
{
}

SnapshotReader::~SnapshotReader() = default;

bool SnapshotReader::has(std::string const& name) const
{
    return image_->has_array(name) || image_->has_value(name);
}

int SnapshotReader::components(std::string const& name) const
{
    Handle const data = image_->array(name);
    auto const sizes = hdf5::sizes_of(Handle(H5Dget_space(data.get()), H5Sclose, "size of " + name));
    return sizes.size() < 2 ? 1 : static_cast<int>(sizes[1]);
}

std::vector<double> SnapshotReader::doubles(std::string const& name) const
{
    return image_->read_array<double>(name);
}

std::vector<std::int64_t> SnapshotReader::int64s(std::string const& name) const
{
    return image_->read_array<std::int64_t>(name);
}

std::vector<std::int32_t> SnapshotReader::int32s(std::string const& name) const
{
    return image_->read_array<std::int32_t>(name);
}

double SnapshotReader::number(std::string const& name) const
{
    return image_->read_value<double>(name);
}
std::int64_t SnapshotReader::integer(std::string const& name) const
{
    return image_->read_value<std::int64_t>(name);
}

std::string SnapshotReader::text(std::string const& name) const
{
    Handle const attribute = image_->value(name);
    Handle const type(H5Aget_type(attribute.get()), H5Tclose, "type of " + name);
    if (H5Tget_class(type.get()) != H5T_STRING) image_->fail("has a value \"" + name + "\" of another type");
    std::vector<char> characters(H5Tget_size(type.get()) + 1, '\0');
    hdf5::check(H5Aread(attribute.get(), type.get(), characters.data()), "value " + name);
    return characters.data();
}

}  // namespace gimdem::output
