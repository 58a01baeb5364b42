// SPDX-License-Identifier: BSD-3-Clause
#include "message/Fields.hpp"

#include <algorithm>
#include <utility>

#include "message/Arrays.hpp"
#include "message/Compression.hpp"
#include "message/Finite.hpp"
#include "message/Runs.hpp"
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

/// The cells of a field that travel; none where it travels whole.
std::optional<CellRuns> cells_to_send(FieldLayout const& layout, std::string const& field, std::size_t cell_count)
{
    if (!layout.encodings.sparse) return std::nullopt;
    CellRuns const* const cells = layout.needed != nullptr ? needed_cells(*layout.needed, field) : layout.solid;
    if (cells == nullptr) return std::nullopt;
    auto const most = static_cast<double>(cell_count) * most_sparse;
    if (static_cast<double>(coupling::cell_count(*cells)) > most) return std::nullopt;
    return *cells;
}

bool is_same(std::optional<CellRuns> const& cells, std::optional<CellRuns> const& others)
{
    return cells && others &&
           std::equal(cells->begin(), cells->end(), others->begin(), others->end(),
                      [](CellRun const& a, CellRun const& b) { return a.first == b.first && a.count == b.count; });
}

/// Of the next array, whose frame comes then. Runs that the sparse array before it has told are not told again.
void add_header(Message& message, char const* name, unsigned components, std::optional<CellRuns> const& cells,
                std::size_t cell_count, Encodings const& encodings)
{
    auto const told = std::find_if(message.unfilled.rbegin(), message.unfilled.rend(),
                                   [](Unfilled const& field) { return field.cells && !field.cells->empty(); });
    v1::ArrayHeader& header = *message.envelope.add_arrays();
    header.set_name(name);
    header.set_type(encodings.float32 ? v1::ELEMENT_TYPE_F32 : v1::ELEMENT_TYPE_F64);
    header.set_components(components);
    header.set_count(cells ? coupling::cell_count(*cells) : cell_count);
    header.set_dense(!cells);
    if (cells && (told == message.unfilled.rend() || !is_same(cells, told->cells)))
        pack_runs(*cells, *header.mutable_runs());
}

std::size_t byte_count(v1::ArrayHeader const& header)
{
    return header.count() * header.components() * element_size(header.type());
}

template <class T>
bool gather(Unfilled const& field, unsigned components, T* to)
{
    bool finite = true;
    for (CellRun const& run : *field.cells)
    {
        std::size_t const size = static_cast<std::size_t>(run.count) * components;
        finite &= copy_finite({field.values.data() + static_cast<std::size_t>(run.first) * components, size}, to);
        to += size;
    }
    return finite;
}

/// Copies what travels into the frame. False if a number is NaN or infinite, or too large for a float.
bool pack_rows(Unfilled const& field, v1::ArrayHeader const& header, transport::Frame& frame)
{
    if (header.type() == v1::ELEMENT_TYPE_F32)
    {
        auto* const to = static_cast<float*>(frame.data());
        return field.cells ? gather(field, header.components(), to) : copy_finite(field.values, to);
    }
    auto* const to = static_cast<double*>(frame.data());
    if (field.cells) return gather(field, header.components(), to);
    return field.is_shared ? stream_finite(field.values, to) : copy_finite(field.values, to);
}

[[noreturn]] void refuse_own(Unfilled const& field, v1::ArrayHeader const& header)
{
    auto const i = first_not_finite(field.values);
    if (!i)
        throw CouplingError(Fault::user, "field \"" + header.name() +
                                             "\" has a number beyond the largest float (3.4e38); do without float32");
    refuse_divergence(header.name(), header.components(), field.values, *i);
}

bool is_real(v1::ArrayHeader const& header)
{
    return header.type() == v1::ELEMENT_TYPE_F64 || header.type() == v1::ELEMENT_TYPE_F32;
}

Span<double const> numbers_of(transport::Frame const& frame)
{
    return {static_cast<double const*>(frame.data()), frame.size() / sizeof(double)};
}

bool is_used_in_place(v1::ArrayHeader const& header)
{
    return header.dense() && header.type() != v1::ELEMENT_TYPE_F32 && header.compression() == v1::COMPRESSION_NONE;
}

int position_of(Message const& message, char const* name, unsigned components)
{
    auto const& headers = message.envelope.arrays();
    auto const who = [&] { return describe(message) + ": array \"" + name + "\""; };
    auto const found = std::find_if(headers.begin(), headers.end(),
                                    [&](v1::ArrayHeader const& header) { return header.name() == name; });
    if (found == headers.end()) refuse(who() + " is missing");
    if (!is_real(*found)) refuse(who() + " has another element type than docs/protocol.md tells");
    if (found->components() != components)
        refuse(who() + " has " + std::to_string(found->components()) + " components instead of " +
               std::to_string(components));
    return static_cast<int>(found - headers.begin());
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
                    transport::SendMemory const& memory, FieldLayout const& layout)
{
    memory.begin_message();
    for (auto const& entry : choice)
    {
        Span<double const> const values = fields.*entry.values;
        check_size(entry, values, cell_count);
        auto cells = cells_to_send(layout, entry.name, cell_count);
        add_header(message, entry.name, entry.components, cells, cell_count, layout.encodings);
        v1::ArrayHeader const& header = *message.envelope.arrays().rbegin();
        transport::Frame frame = memory.make(byte_count(header), layout.encodings.sparse);
        auto const offset = memory.offset_of(frame);
        message.unfilled.push_back(
            {message.arrays.size(), values, offset.has_value(), std::move(cells), layout.encodings.lz4 && !offset});
        message.arrays.push_back(std::move(frame));
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
        v1::ArrayHeader& header = *message.envelope.mutable_arrays(static_cast<int>(field.array));
        transport::Frame& frame = message.arrays[field.array];
        if (!pack_rows(field, header, frame)) refuse_own(field, header);
        if (field.compress)
            if (transport::Frame packed = compress(frame, element_size(header.type())); packed.size() > 0)
            {
                frame = std::move(packed);
                header.set_compression(v1::COMPRESSION_SHUFFLED_LZ4);
            }
        if (filled) filled(field.array + 1);
    }
    message.unfilled.clear();
}

template <class Fields>
void take_in(Message& message, std::size_t count, FieldChoice<Fields> const& choice, std::size_t cell_count,
             FieldStore const& store)
{
    std::size_t const most = std::min({count, message.arrays.size(), choice.size()});
    for (std::size_t k = message.taken_in.size(); k < most; ++k)
    {
        v1::ArrayHeader const& header = message.envelope.arrays(static_cast<int>(k));
        // What is not as we would lay it out is left to view_fields(), which tells what is wrong.
        if (header.name() != choice[k].name || header.components() != choice[k].components || !is_real(header)) return;
        Span<double const> values = numbers_of(message.arrays[k]);
        if (!is_used_in_place(header))
            values = store.receive(message, static_cast<int>(k), cell_count);
        else if (!all_finite(values))
            return;
        message.taken_in.push_back(values);
    }
}

template <class Fields>
std::size_t shared_bytes(FieldChoice<Fields> const& choice, std::size_t cell_count, bool any_size)
{
    std::size_t large = 0, all = 0;
    for (auto const& entry : choice)
    {
        large += transport::shared_bytes(cell_count * entry.components * sizeof(double));
        all += transport::aligned_bytes(cell_count * entry.components * sizeof(double));
    }
    return any_size && large > 0 ? all : large;
}

template <class Fields>
Fields view_fields(Message const& message, FieldChoice<Fields> const& choice, std::size_t cell_count,
                   FieldStore const& store)
{
    Fields fields;
    for (auto const& entry : choice)
    {
        int const k = position_of(message, entry.name, entry.components);
        bool const is_taken_in = static_cast<std::size_t>(k) < message.taken_in.size();
        if (!is_used_in_place(message.envelope.arrays(k)))
        {
            fields.*entry.values =
                is_taken_in ? message.taken_in[static_cast<std::size_t>(k)] : store.receive(message, k, cell_count);
            continue;
        }
        Span<double const> const values = view_array<double>(message, entry.name, entry.components, cell_count);
        if (auto const i = is_taken_in ? std::nullopt : first_not_finite(values))
            refuse(describe(message) + ": " + not_finite_text(entry.name, entry.components, values, *i));
        fields.*entry.values = values;
    }
    check_array_count(message, choice.size());
    return fields;
}

template void lay_out_fields(Message&, FieldChoice<FluidFields> const&, FluidFields const&, std::size_t,
                             transport::SendMemory const&, FieldLayout const&);
template void lay_out_fields(Message&, FieldChoice<SolidFields> const&, SolidFields const&, std::size_t,
                             transport::SendMemory const&, FieldLayout const&);
template void check_fields(FieldChoice<SolidFields> const&, SolidFields const&, std::size_t);
template void take_in(Message&, std::size_t, FieldChoice<FluidFields> const&, std::size_t, FieldStore const&);
template void take_in(Message&, std::size_t, FieldChoice<SolidFields> const&, std::size_t, FieldStore const&);
template std::size_t shared_bytes(FieldChoice<FluidFields> const&, std::size_t, bool);
template std::size_t shared_bytes(FieldChoice<SolidFields> const&, std::size_t, bool);
template FluidFields view_fields(Message const&, FieldChoice<FluidFields> const&, std::size_t, FieldStore const&);
template SolidFields view_fields(Message const&, FieldChoice<SolidFields> const&, std::size_t, FieldStore const&);

}  // namespace gimdem::coupling::message
