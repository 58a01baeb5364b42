// SPDX-License-Identifier: BSD-3-Clause
#include "message/Arrays.hpp"

#include <cstring>

namespace gimdem::coupling::message
{
namespace
{

static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__, "the arrays on the wire are little-endian, as in memory");

template <class T>
v1::ElementType constexpr element_type = v1::ELEMENT_TYPE_UNSPECIFIED;
template <>
v1::ElementType constexpr element_type<double> = v1::ELEMENT_TYPE_F64;
template <>
v1::ElementType constexpr element_type<std::int32_t> = v1::ELEMENT_TYPE_I32;
template <>
v1::ElementType constexpr element_type<std::int64_t> = v1::ELEMENT_TYPE_I64;

bool is_aligned(transport::Frame const& frame, std::size_t size)
{
    return reinterpret_cast<std::uintptr_t>(frame.data()) % size == 0;
}

int find(v1::Envelope const& envelope, std::string const& name)
{
    for (int k = 0; k < envelope.arrays_size(); ++k)
        if (envelope.arrays(k).name() == name) return k;
    return -1;
}

template <class T>
void append(Message& message, std::string const& name, unsigned components, transport::Frame frame)
{
    v1::ArrayHeader* const header = message.envelope.add_arrays();
    header->set_name(name);
    header->set_type(element_type<T>);
    header->set_components(components);
    header->set_count(frame.size() / sizeof(T) / components);
    header->set_dense(true);
    message.arrays.push_back(std::move(frame));
}

}  // namespace

std::size_t element_size(v1::ElementType type)
{
    switch (type)
    {
        case v1::ELEMENT_TYPE_F64:
        case v1::ELEMENT_TYPE_I64:
            return 8;
        case v1::ELEMENT_TYPE_I32:
        case v1::ELEMENT_TYPE_F32:
            return 4;
        default:
            return 0;
    }
}

void align(transport::Frame& frame, std::size_t size)
{
    if (is_aligned(frame, size)) return;
    // ZeroMQ hands out pieces of its read buffer for small frames; its own allocations are aligned.
    transport::Frame copy(frame.size());
    if (is_aligned(copy, size))
    {
        std::memcpy(copy.data(), frame.data(), frame.size());
        frame = std::move(copy);
        return;
    }
    // A frame so small that ZeroMQ keeps it inside the handle itself.
    auto* const bytes = new unsigned char[frame.size()];
    std::memcpy(bytes, frame.data(), frame.size());
    frame =
        transport::Frame(bytes, frame.size(), [](void* data, void*) { delete[] static_cast<unsigned char*>(data); });
}

template <class T>
void append_array(Message& message, std::string const& name, unsigned components, Span<T const> values)
{
    transport::Frame frame(values.size() * sizeof(T));
    if (!values.empty()) std::memcpy(frame.data(), values.data(), frame.size());
    append<T>(message, name, components, std::move(frame));
}

void append_array(Message& message, std::string const& name, unsigned components, transport::Frame frame)
{
    append<double>(message, name, components, std::move(frame));
}

template <class T>
Span<T const> view_array(Message const& message, std::string const& name, unsigned components,
                         std::optional<std::size_t> rows)
{
    int const k = find(message.envelope, name);
    auto const who = [&] { return describe(message) + ": array \"" + name + "\""; };
    if (k < 0) refuse(who() + " is missing");

    v1::ArrayHeader const& header = message.envelope.arrays(k);
    if (header.type() != element_type<T>) refuse(who() + " has another element type than docs/protocol.md tells");
    if (header.components() != components)
        refuse(who() + " has " + std::to_string(header.components()) + " components instead of " +
               std::to_string(components));
    if (rows && header.count() != *rows)
        refuse(who() + " has " + std::to_string(header.count()) + " rows instead of " + std::to_string(*rows));

    transport::Frame const& frame = message.arrays[static_cast<std::size_t>(k)];
    return {static_cast<T const*>(frame.data()), frame.size() / sizeof(T)};
}

void check_array_count(Message const& message, std::size_t count)
{
    if (message.arrays.size() != count)
        refuse(describe(message) + " has " + std::to_string(message.arrays.size()) + " arrays instead of " +
               std::to_string(count));
}

template void append_array(Message&, std::string const&, unsigned, Span<double const>);
template void append_array(Message&, std::string const&, unsigned, Span<std::int32_t const>);
template void append_array(Message&, std::string const&, unsigned, Span<std::int64_t const>);
template Span<double const> view_array(Message const&, std::string const&, unsigned, std::optional<std::size_t>);
template Span<std::int32_t const> view_array(Message const&, std::string const&, unsigned, std::optional<std::size_t>);
template Span<std::int64_t const> view_array(Message const&, std::string const&, unsigned, std::optional<std::size_t>);

}  // namespace gimdem::coupling::message
