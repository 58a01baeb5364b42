// SPDX-License-Identifier: BSD-3-Clause
/// Values as TOML text: for messages and for the defaults in the documentation.
#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace gimdem::case_file
{

std::string to_text(double value);  ///< shortest that reads back to the same bits

template <std::integral Integer>
std::string to_text(Integer value)
{
    return std::to_string(value);
}

inline std::string to_text(bool value)
{
    return value ? "true" : "false";
}
inline std::string to_text(std::string const& value)
{
    return '"' + value + '"';
}
inline std::string to_text(std::filesystem::path const& value)
{
    return to_text(value.string());
}

template <class T, std::size_t size>
std::string to_text(std::array<T, size> const& values);

template <class Range>
std::string list_to_text(Range const& values)
{
    std::string text;
    for (auto const& value : values)
        text += (text.empty() ? "" : ", ") + to_text(value);
    return '[' + text + ']';
}

template <class T, std::size_t size>
std::string to_text(std::array<T, size> const& values)
{
    return list_to_text(values);
}

inline std::string to_text(std::vector<std::string> const& values)
{
    return list_to_text(values);
}
inline std::string to_text(std::vector<double> const& values)
{
    return list_to_text(values);
}

}  // namespace gimdem::case_file
