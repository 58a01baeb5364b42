// SPDX-License-Identifier: BSD-3-Clause
#include "output/VtkXml.hpp"

#include <zlib.h>

#include <algorithm>
#include <bit>
#include <stdexcept>

#include "output/OutputFile.hpp"
#include "output/Text.hpp"

namespace gimdem::output
{

namespace
{

constexpr std::size_t block_size = std::size_t{1} << 18;  ///< bytes that are compressed together

/// VTK's layout: number of blocks, size of a block, size of the last if it is shorter, compressed sizes; then the
/// blocks.
std::vector<std::byte> compressed(std::span<std::byte const> bytes)
{
    std::size_t const block_count = (bytes.size() + block_size - 1) / block_size;
    std::vector<std::uint64_t> sizes{block_count, block_size, bytes.size() % block_size};
    std::vector<std::byte> blocks;
    for (std::size_t start = 0; start < bytes.size(); start += block_size)
    {
        auto const block = bytes.subspan(start, std::min(block_size, bytes.size() - start));
        std::size_t const end = blocks.size();
        uLongf size = compressBound(block.size());
        blocks.resize(end + size);
        int const status = compress2(reinterpret_cast<Bytef*>(blocks.data() + end), &size,
                                     reinterpret_cast<Bytef const*>(block.data()), block.size(), Z_BEST_SPEED);
        if (status != Z_OK) throw std::runtime_error("zlib cannot compress a block (out of memory)");
        blocks.resize(end + size);
        sizes.push_back(size);
    }
    auto const header = std::as_bytes(std::span(sizes));
    blocks.insert(blocks.begin(), header.begin(), header.end());
    return blocks;
}

template <class T>
VtkArray make_array(std::string const& type, std::string const& name, std::span<T const> values, int components)
{
    std::string attributes = "type=\"" + type + "\" Name=\"" + xml_escaped(name) + '"';
    if (components > 1) attributes += " NumberOfComponents=\"" + std::to_string(components) + '"';
    return {attributes, compressed(std::as_bytes(values))};
}

}  // namespace

VtkArray vtk_reals(std::string const& name, std::span<double const> values, int components)
{
    std::vector<float> const single(values.begin(), values.end());
    return make_array("Float32", name, std::span(single), components);
}

VtkArray vtk_integers(std::string const& name, std::span<std::int64_t const> values)
{
    return make_array("Int64", name, values, 1);
}

VtkArray vtk_bytes(std::string const& name, std::span<std::uint8_t const> values)
{
    return make_array("UInt8", name, values, 1);
}

VtkArray vtk_time(double time)
{
    auto array = make_array("Float64", "TimeValue", std::span<double const>(&time, 1), 1);
    array.attributes += " NumberOfTuples=\"1\"";
    return array;
}

VtkDocument::VtkDocument(std::string const& type)
{
    std::string const order = std::endian::native == std::endian::little ? "LittleEndian" : "BigEndian";
    head_ = "<?xml version=\"1.0\"?>\n";
    open("VTKFile", "type=\"" + type + "\" version=\"1.0\" byte_order=\"" + order +
                        "\" header_type=\"UInt64\" compressor=\"vtkZLibDataCompressor\"");
    open(type);
}

VtkDocument& VtkDocument::open(std::string const& tag, std::string const& attributes)
{
    head_.append(2 * open_tags_.size(), ' ').append("<").append(tag);
    if (!attributes.empty()) head_.append(" ").append(attributes);
    head_ += ">\n";
    open_tags_.push_back(tag);
    return *this;
}

VtkDocument& VtkDocument::add(VtkArray const& array)
{
    head_.append(2 * open_tags_.size(), ' ').append("<DataArray ").append(array.attributes);
    head_ += " format=\"appended\" offset=\"" + std::to_string(offset_) + "\"/>\n";
    arrays_.push_back(&array);
    offset_ += array.block.size();
    return *this;
}

VtkDocument& VtkDocument::close()
{
    std::string const tag = open_tags_.back();
    open_tags_.pop_back();
    head_.append(2 * open_tags_.size(), ' ').append("</").append(tag).append(">\n");
    return *this;
}

void VtkDocument::write(std::filesystem::path const& file)
{
    while (open_tags_.size() > 1)
        close();
    OutputFile out(file);
    out.write(head_);
    out.write("  <AppendedData encoding=\"raw\">\n_");
    for (auto const* array : arrays_)
        out.write(array->block);
    out.write("\n  </AppendedData>\n</VTKFile>\n");
    out.commit();
}

}  // namespace gimdem::output
