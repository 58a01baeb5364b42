// SPDX-License-Identifier: BSD-3-Clause
#include "message/Fields.hpp"

#include <algorithm>
#include <utility>

#include "message/Arrays.hpp"
#include "message/Finite.hpp"
#include "message/SharedArrays.hpp"

namespace gimdem::coupling::message
{
namespace
{

template <class Table>
std::string names_of(Table const& table)
{
    std::string names;
    for (auto const& entry : table)
        names.append(names.empty() ? "" : ", ").append(entry.name);
    return names;
}

template <class Table>
void check_names(std::vector<std::string> const& names, Table const& table, std::string const& kind, Fault fault)
{
    for (std::string const& name : names)
    {
        bool const known =
            std::any_of(table.begin(), table.end(), [&](auto const& entry) { return name == entry.name; });
        if (!known)
            throw CouplingError(fault, "unknown " + kind + " field \"" + name.substr(0, max_name_bytes) +
                                           "\" (there are " + names_of(table) + "); check its spelling");
        if (std::count(names.begin(), names.end(), name) > 1)
            throw CouplingError(fault, kind + " field \"" + name + "\" is asked for twice; name it once");
    }
}

template <class Fields, class Table>
FieldChoice<Fields> choose(std::vector<std::string> const& names, Table const& table)
{
    FieldChoice<Fields> choice;
    for (auto const& entry : table)
        if (std::find(names.begin(), names.end(), entry.name) != names.end()) choice.push_back(entry);
    return choice;
}

/// "velocity has nan in cell 12".
std::string not_finite_text(std::string const& name, unsigned components, Span<double const> values, std::size_t i)
{
    return "field \"" + name + "\" has " + number_text(values[i]) + " in cell " + std::to_string(i / components);
}

bool is_known_finite(Message const& message, Span<double const> values)
{
    auto const end = message.arrays.begin() + static_cast<std::ptrdiff_t>(message.finite);
    return std::any_of(message.arrays.begin(), end,
                       [&](transport::Frame const& frame) { return frame.data() == values.data(); });
}

template <class Fields>
void check_size(FieldEntry<Fields> const& entry, Span<double const> values, std::size_t cell_count)
{
    std::size_t const size = cell_count * entry.components;
    if (values.size() != size)
        throw CouplingError(Fault::user, "field \"" + std::string(entry.name) + "\" has " +
                                             std::to_string(values.size()) + " numbers (the mesh has " +
                                             std::to_string(cell_count) + " cells, " +
                                             std::to_string(entry.components) + " each, so " + std::to_string(size) +
                                             "); pass the whole field, the peer needs it");
}

[[noreturn]] void refuse_divergence(std::string const& name, unsigned components, Span<double const> values,
                                    std::size_t i)
{
    throw CouplingError(Fault::user, not_finite_text(name, components, values, i) +
                                         " (the solution has diverged); try a smaller time step");
}

}  // namespace

FieldChoice<FluidFields> choose_fluid_fields(std::vector<std::string> const& names, Fault fault)
{
    check_names(names, fluid_fields, "fluid", fault);
    return choose<FluidFields>(names, fluid_fields);
}

FieldChoice<SolidFields> choose_solid_fields(std::vector<std::string> const& names, Fault fault)
{
    check_names(names, solid_fields, "solid", fault);
    return choose<SolidFields>(names, solid_fields);
}

template <class Fields>
void lay_out_fields(Message& message, FieldChoice<Fields> const& choice, Fields const& fields, std::size_t cell_count,
                    transport::SendMemory const& memory)
{
    memory.begin_message();
    for (auto const& entry : choice)
    {
        Span<double const> const values = fields.*entry.values;
        check_size(entry, values, cell_count);
        transport::Frame frame = memory.make(values.size() * sizeof(double));
        auto const offset = memory.offset_of(frame);
        message.unfilled.push_back({message.arrays.size(), values, offset.has_value()});
        append_array(message, entry.name, entry.components, std::move(frame));
        if (offset) mark_shared(message, *offset);
    }
}

template <class Fields>
void check_fields(FieldChoice<Fields> const& choice, Fields const& fields, std::size_t cell_count)
{
    for (auto const& entry : choice)
    {
        Span<double const> const values = fields.*entry.values;
        check_size(entry, values, cell_count);
        if (auto const i = first_not_finite(values)) refuse_divergence(entry.name, entry.components, values, *i);
    }
}

void fill(Message& message, std::function<void(std::size_t)> const& filled)
{
    for (Unfilled const& field : message.unfilled)
    {
        auto* const to = static_cast<double*>(message.arrays[field.array].data());
        if (field.is_shared ? stream_finite(field.values, to) : copy_finite(field.values, to))
        {
            if (filled) filled(field.array + 1);
            continue;
        }
        v1::ArrayHeader const& header = message.envelope.arrays(static_cast<int>(field.array));
        refuse_divergence(header.name(), header.components(), field.values, *first_not_finite(field.values));
    }
    message.unfilled.clear();
}

void look_through(Message& message, std::size_t count)
{
    for (; message.finite < std::min(count, message.arrays.size()); ++message.finite)
    {
        std::size_t const k = message.finite;
        transport::Frame const& frame = message.arrays[k];
        bool const is_real = message.envelope.arrays(static_cast<int>(k)).type() == v1::ELEMENT_TYPE_F64;
        if (is_real && !all_finite({static_cast<double const*>(frame.data()), frame.size() / sizeof(double)})) return;
    }
}

template <class Fields>
std::size_t shared_bytes(FieldChoice<Fields> const& choice, std::size_t cell_count)
{
    std::size_t sum = 0;
    for (auto const& entry : choice)
        sum += transport::shared_bytes(cell_count * entry.components * sizeof(double));
    return sum;
}

template <class Fields>
Fields view_fields(Message const& message, FieldChoice<Fields> const& choice, std::size_t cell_count)
{
    Fields fields;
    for (auto const& entry : choice)
    {
        Span<double const> const values = view_array<double>(message, entry.name, entry.components, cell_count);
        if (auto const i = is_known_finite(message, values) ? std::nullopt : first_not_finite(values))
            refuse(describe(message) + ": " + not_finite_text(entry.name, entry.components, values, *i));
        fields.*entry.values = values;
    }
    check_array_count(message, choice.size());
    return fields;
}

template void lay_out_fields(Message&, FieldChoice<FluidFields> const&, FluidFields const&, std::size_t,
                             transport::SendMemory const&);
template void lay_out_fields(Message&, FieldChoice<SolidFields> const&, SolidFields const&, std::size_t,
                             transport::SendMemory const&);
template void check_fields(FieldChoice<SolidFields> const&, SolidFields const&, std::size_t);
template std::size_t shared_bytes(FieldChoice<FluidFields> const&, std::size_t);
template std::size_t shared_bytes(FieldChoice<SolidFields> const&, std::size_t);
template FluidFields view_fields(Message const&, FieldChoice<FluidFields> const&, std::size_t);
template SolidFields view_fields(Message const&, FieldChoice<SolidFields> const&, std::size_t);

}  // namespace gimdem::coupling::message
