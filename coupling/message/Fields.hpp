// SPDX-License-Identifier: BSD-3-Clause
/// The cell fields that travel: which there are, which of them this run sends, and their checks.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "gimdem/coupling/Types.hpp"
#include "message/FieldStore.hpp"
#include "message/Message.hpp"
#include "transport/SendMemory.hpp"

namespace gimdem::coupling::message
{

/// One cell field: its name on the wire, numbers per cell, and its place in FluidFields or SolidFields.
template <class Fields>
struct FieldEntry
{
    char const* name;
    unsigned components;
    Span<double const> Fields::*values;
};

inline constexpr std::array<FieldEntry<FluidFields>, 5> fluid_fields{
    {{field::velocity, 3, &FluidFields::velocity},
     {field::velocity_gradient, 9, &FluidFields::velocity_gradient},
     {field::pressure_gradient, 3, &FluidFields::pressure_gradient},
     {field::void_fraction_gradient, 3, &FluidFields::void_fraction_gradient},
     {field::pressure, 1, &FluidFields::pressure}}};

inline constexpr std::array<FieldEntry<SolidFields>, 4> solid_fields{
    {{field::void_fraction, 1, &SolidFields::void_fraction},
     {field::momentum_source, 3, &SolidFields::momentum_source},
     {field::drag_coefficient, 1, &SolidFields::drag_coefficient},
     {field::drag_momentum, 3, &SolidFields::drag_momentum}}};

/// The fields that a session sends in one direction.
template <class Fields>
using FieldChoice = std::vector<FieldEntry<Fields>>;

/// The fields of those names, in the order of the table. CouplingError(fault) if a name is unknown or comes twice.
FieldChoice<FluidFields> choose_fluid_fields(std::vector<std::string> const& names, Fault fault);
FieldChoice<SolidFields> choose_solid_fields(std::vector<std::string> const& names, Fault fault);

/// How the fields of a message are to travel.
struct FieldLayout
{
    Encodings encodings;                               ///< in force
    std::vector<NeededCells> const* needed = nullptr;  ///< of a fluid, where not all cells are
    CellRuns const* solid = nullptr;                   ///< of a solid, where not all cells are
};

/// Adds the chosen fields to a message, in shared memory where the peer reads it, and leaves the copying to fill().
/// Fault::user if one has not cell_count rows.
template <class Fields>
void lay_out_fields(Message& message, FieldChoice<Fields> const& choice, Fields const& fields, std::size_t cell_count,
                    transport::SendMemory const& memory, FieldLayout const& layout = {});

/// Fault::user if one of the chosen fields has not cell_count rows, or has a NaN or infinity in it.
template <class Fields>
void check_fields(FieldChoice<Fields> const& choice, Fields const& fields, std::size_t cell_count);

/// Copies what is unfilled; calls filled(n) when n arrays of the message are. Fault::user for a NaN or infinity.
void fill(Message& message, std::function<void(std::size_t)> const& filled = {});

/// Takes in the first `count` arrays of a message that is still being packed, as far as that was not done and they are
/// the chosen ones: looks for NaN and infinity, and copies what is not used in place. Fault::protocol as view_fields().
template <class Fields>
void take_in(Message& message, std::size_t count, FieldChoice<Fields> const& choice, std::size_t cell_count,
             FieldStore const& store);

/// Bytes of shared memory that one message with the chosen fields takes. any_size: small ones lie there, too, beside
/// large ones.
template <class Fields>
std::size_t shared_bytes(FieldChoice<Fields> const& choice, std::size_t cell_count, bool any_size = false);

/// Bytes of the chosen fields.
template <class Fields>
std::size_t field_bytes(FieldChoice<Fields> const& choice, std::size_t cell_count)
{
    std::size_t components = 0;
    for (auto const& entry : choice)
        components += entry.components;
    return components * cell_count * sizeof(double);
}

/// The chosen fields, in place, or in the store if they travel in another form than they are used; the others are
/// empty. Fault::protocol if the message has others than the chosen ones, or the wrong sizes, or a NaN or infinity.
template <class Fields>
Fields view_fields(Message const& message, FieldChoice<Fields> const& choice, std::size_t cell_count,
                   FieldStore const& store = {});

}  // namespace gimdem::coupling::message
