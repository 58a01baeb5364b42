// SPDX-License-Identifier: BSD-3-Clause
/// The container of VTK's XML files: arrays, zlib-compressed, appended raw behind a short XML head.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace gimdem::output
{

/// An array ready to be appended, as often as wanted.
struct VtkArray
{
    std::string attributes;        ///< of its DataArray element: type, name, components
    std::vector<std::byte> block;  ///< compressed, with VTK's header of block sizes
};

/// Reals as Float32, shape=(values.size() / components, components).
VtkArray vtk_reals(std::string const& name, std::span<double const> values, int components = 1);

/// Whole numbers as Int64 or UInt8.
VtkArray vtk_integers(std::string const& name, std::span<std::int64_t const> values);
VtkArray vtk_bytes(std::string const& name, std::span<std::uint8_t const> values);

/// The time of a file [s], as ParaView looks for it.
VtkArray vtk_time(double time);

/// One file, built from top to bottom. The arrays must live until write().
class VtkDocument
{
public:
    /// `type`: PolyData, UnstructuredGrid, ...
    explicit VtkDocument(std::string const& type);

    VtkDocument& open(std::string const& tag, std::string const& attributes = "");
    VtkDocument& add(VtkArray const& array);
    VtkDocument& close();  ///< the tag opened last

    /// Close all tags and write the file, whole or not at all. Throws UserError.
    void write(std::filesystem::path const& file);

private:
    std::string head_;
    std::vector<std::string> open_tags_;
    std::vector<VtkArray const*> arrays_;
    std::size_t offset_ = 0;  ///< of the next array behind the head [bytes]
};

}  // namespace gimdem::output
