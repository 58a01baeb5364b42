// SPDX-License-Identifier: BSD-3-Clause
/// An independent reader of the VTK files that the tests look into.
#pragma once

#include <zlib.h>

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "Files.hpp"

namespace gimdem::test
{

/// Text and arrays of a .vtp or .vtu file with raw appended, zlib-compressed arrays.
class VtkFile
{
public:
    explicit VtkFile(std::filesystem::path const& file) : text_(read_text(file))
    {
        std::string const start = "<AppendedData encoding=\"raw\">\n_";
        auto const at = text_.find(start);
        if (at == std::string::npos) throw std::runtime_error("no appended data in " + file.string());
        data_ = text_.substr(at + start.size());
        text_.resize(at);
    }

    std::string const& head() const { return text_; }

    bool has(std::string const& name) const { return text_.find("Name=\"" + name + '"') != std::string::npos; }

    /// Attribute of the DataArray `name`, empty where it has none.
    std::string attribute(std::string const& name, std::string const& key) const
    {
        auto const named = text_.find("Name=\"" + name + '"');
        auto const begin = named == std::string::npos ? named : text_.rfind("<DataArray ", named);
        if (begin == std::string::npos) throw std::runtime_error("no array " + name);
        std::string const element = text_.substr(begin, text_.find('>', begin) - begin);
        auto const at = element.find(' ' + key + "=\"");
        if (at == std::string::npos) return "";
        auto const value = at + key.size() + 3;
        return element.substr(value, element.find('"', value) - value);
    }

    template <class T>
    std::vector<T> array(std::string const& name) const
    {
        std::string const bytes = uncompressed(std::stoul(attribute(name, "offset")));
        std::vector<T> values(bytes.size() / sizeof(T));
        if (!values.empty()) std::memcpy(values.data(), bytes.data(), bytes.size());
        return values;
    }

private:
    std::uint64_t word(std::size_t at) const
    {
        std::uint64_t value = 0;
        std::memcpy(&value, data_.data() + at, sizeof value);
        return value;
    }

    /// number of blocks, size of a block, size of the last, compressed sizes, blocks
    std::string uncompressed(std::size_t offset) const
    {
        std::uint64_t const blocks = word(offset);
        std::size_t at = offset + 8 * (3 + blocks);
        std::string bytes;
        for (std::uint64_t block = 0; block < blocks; ++block)
        {
            bool const is_short = block + 1 == blocks && word(offset + 16) != 0;
            uLongf size = is_short ? word(offset + 16) : word(offset + 8);
            uLongf const expected = size;
            std::uint64_t const compressed = word(offset + 8 * (3 + block));
            std::string buffer(size, '\0');
            if (uncompress(reinterpret_cast<Bytef*>(buffer.data()), &size,
                           reinterpret_cast<Bytef const*>(data_.data() + at), compressed) != Z_OK ||
                size != expected)
                throw std::runtime_error("a block cannot be uncompressed");
            bytes += buffer;
            at += compressed;
        }
        return bytes;
    }

    std::string text_;
    std::string data_;
};

}  // namespace gimdem::test
