// SPDX-License-Identifier: BSD-3-Clause
/// Structs of client.h, whose size is the caller's: reading and writing no more than both sides know.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <string>

#include "gimdem/coupling/Error.hpp"

namespace gimdem::coupling::c
{

[[noreturn]] inline void refuse(std::string const& text)
{
    throw CouplingError(Fault::user, text);
}

/// A pointer that must not be null.
template <class T>
T& require(T* pointer, char const* what)
{
    if (pointer == nullptr) refuse(std::string(what) + " is NULL (the call needs it); pass its address");
    return *pointer;
}

/// The size that the caller gave its struct. least: of the first version of the struct.
inline std::size_t checked_size(std::size_t size, std::size_t least, char const* what)
{
    if (size >= least) return size;
    refuse(std::string(what) + ".struct_size is " + std::to_string(size) + " (the struct has " + std::to_string(least) +
           " bytes or more); set it to sizeof the struct before the call");
}

/// The caller's struct as this library knows it; members that the caller does not know are 0.
/// \tparam least  bytes of the first version of the struct
template <class T, std::size_t least = sizeof(T)>
T read(T const* given, char const* what)
{
    std::size_t const size = checked_size(require(given, what).struct_size, least, what);
    auto const* bytes = reinterpret_cast<char const*>(given);
    if (size > sizeof(T) && std::any_of(bytes + sizeof(T), bytes + size, [](char byte) { return byte != 0; }))
        refuse(std::string(what) +
               " has members that this library does not know (the program was compiled for a newer "
               "one); set them to 0, or link the newer library");
    T known{};
    std::memcpy(&known, given, std::min(size, sizeof(T)));
    return known;
}

/// Checks a struct that write() will fill later.
template <class T, std::size_t least = sizeof(T)>
void require_room(T* target, char const* what)
{
    checked_size(require(target, what).struct_size, least, what);
}

/// Fills the caller's struct, as far as it goes; what only the caller knows becomes 0. Its size stays.
template <class T>
void write(T known, T* target)
{
    known.struct_size = target->struct_size;
    if (known.struct_size > sizeof(T))
        std::memset(reinterpret_cast<char*>(target) + sizeof(T), 0, known.struct_size - sizeof(T));
    std::memcpy(target, &known, std::min(known.struct_size, sizeof(T)));
}

/// A text that the caller may leave out.
inline std::string text(char const* given)
{
    return given == nullptr ? std::string() : std::string(given);
}

}  // namespace gimdem::coupling::c
