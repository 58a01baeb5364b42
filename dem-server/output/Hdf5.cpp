// SPDX-License-Identifier: BSD-3-Clause
#include "output/Hdf5.hpp"

namespace gimdem::output::hdf5
{

namespace
{

constexpr std::size_t growth = std::size_t{1} << 20;  ///< step in which a file in memory grows [bytes]

Handle memory_driver()
{
    Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "file access");
    bool const to_disk = false;
    check(H5Pset_fapl_core(access.get(), growth, to_disk), "file in memory");
    return access;
}

}  // namespace

Silence::Silence()
{
    H5Eget_auto2(H5E_DEFAULT, &function_, &data_);
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

Silence::~Silence()
{
    H5Eset_auto2(H5E_DEFAULT, function_, data_);
}

Handle create_in_memory()
{
    Handle const access = memory_driver();
    return {H5Fcreate("snapshot", H5F_ACC_TRUNC, H5P_DEFAULT, access.get()), H5Fclose, "creating a file"};
}

Handle open_in_memory(std::span<std::byte const> image)
{
    Handle const access = memory_driver();
    // HDF5 copies the bytes and does not change them, whatever its signature says
    check(H5Pset_file_image(access.get(), const_cast<std::byte*>(image.data()), image.size()), "file image");
    return {H5Fopen("snapshot", H5F_ACC_RDONLY, access.get()), H5Fclose, "opening a file"};
}

std::vector<std::byte> image_of(Handle const& file)
{
    check(H5Fflush(file.get(), H5F_SCOPE_GLOBAL), "flushing");
    ssize_t const size = H5Fget_file_image(file.get(), nullptr, 0);
    if (size < 0) throw std::runtime_error("HDF5 fails at the size of a file");
    std::vector<std::byte> image(static_cast<std::size_t>(size));
    if (H5Fget_file_image(file.get(), image.data(), image.size()) != size)
        throw std::runtime_error("HDF5 fails at the bytes of a file");
    return image;
}

Handle make_space(std::vector<hsize_t> const& sizes)
{
    hid_t const space =
        sizes.empty() ? H5Screate(H5S_SCALAR) : H5Screate_simple(static_cast<int>(sizes.size()), sizes.data(), nullptr);
    return {space, H5Sclose, "dataspace"};
}

std::vector<hsize_t> sizes_of(Handle const& space)
{
    std::vector<hsize_t> sizes(static_cast<std::size_t>(H5Sget_simple_extent_ndims(space.get())));
    check(H5Sget_simple_extent_dims(space.get(), sizes.data(), nullptr), "sizes");
    return sizes;
}

}  // namespace gimdem::output::hdf5
