// SPDX-License-Identifier: BSD-3-Clause
/// Arrays of numbers in frames: one copy on the way out, none on the way in.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include "gimdem/coupling/Span.hpp"
#include "message/Message.hpp"

namespace gimdem::coupling::message
{

inline constexpr unsigned max_components = 9;

/// Bytes of one number; 0 for a type that we do not know.
std::size_t element_size(v1::ElementType type);

/// Gives the bytes of a frame an address that is a multiple of size, by copying them if need be.
void align(transport::Frame& frame, std::size_t size);

/// Adds values to a message, as rows of that many components. T: double, int32_t or int64_t.
template <class T>
void append_array(Message& message, std::string const& name, unsigned components, Span<T const> values);
/// The same for doubles that are in their frame already.
void append_array(Message& message, std::string const& name, unsigned components, transport::Frame frame);

/// The numbers of the array of that name, in place; they live as long as the message. Fault::protocol if it is absent,
/// has another type or components, or another number of rows than asked for.
template <class T>
Span<T const> view_array(Message const& message, std::string const& name, unsigned components,
                         std::optional<std::size_t> rows = std::nullopt);

/// Fault::protocol unless the message has exactly so many arrays.
void check_array_count(Message const& message, std::size_t count);

}  // namespace gimdem::coupling::message
