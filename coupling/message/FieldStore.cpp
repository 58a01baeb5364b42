// SPDX-License-Identifier: BSD-3-Clause
#include "message/FieldStore.hpp"

#include <algorithm>
#include <map>
#include <vector>

#include "gimdem/coupling/Types.hpp"
#include "message/Compression.hpp"
#include "message/Finite.hpp"
#include "message/Runs.hpp"

namespace gimdem::coupling::message
{
namespace
{

struct Field
{
    std::vector<double> values;           ///< of all cells
    CellRuns filled;                      ///< the cells that may hold anything else than the empty value
    std::vector<unsigned char> unpacked;  ///< bytes of a compressed frame
};

/// Gives all cells but those of `runs` the empty value.
void clear_others(Field& field, std::size_t size, unsigned components, double empty, CellRuns const& runs)
{
    if (field.values.size() != size)
        field.values.assign(size, empty);
    else if (!contains(runs, field.filled))
        for (CellRun const& run : field.filled)
            std::fill_n(field.values.begin() + static_cast<std::ptrdiff_t>(components) * run.first,
                        static_cast<std::size_t>(run.count) * components, empty);
    field.filled = runs;
}

/// Rows to their cells. False if a number is NaN or infinite.
template <class T>
bool scatter(T const* from, CellRuns const& runs, unsigned components, double* to)
{
    bool finite = true;
    for (CellRun const& run : runs)
    {
        std::size_t const size = static_cast<std::size_t>(run.count) * components;
        finite &= copy_finite(Span<T const>(from, size), to + static_cast<std::size_t>(run.first) * components);
        from += size;
    }
    return finite;
}

[[noreturn]] void refuse_not_finite(Message const& message, std::string const& name, CellRuns const& runs,
                                    unsigned components, std::vector<double> const& values)
{
    for (CellRun const& run : runs)
    {
        auto const first = static_cast<std::size_t>(run.first) * components;
        std::size_t const size = static_cast<std::size_t>(run.count) * components;
        if (auto const i = first_not_finite({values.data() + first, size}))
            refuse(describe(message) + ": field \"" + name + "\" has " + number_text(values[first + *i]) + " in cell " +
                   std::to_string((first + *i) / components));
    }
    refuse(describe(message) + ": field \"" + name + "\" is not finite");
}

CellRuns cells_of(Message const& message, int k, std::size_t cell_count)
{
    v1::ArrayHeader const& header = message.envelope.arrays(k);
    if (!header.dense()) return cells_of_array(message.envelope, k, cell_count);
    if (header.count() != cell_count)
        refuse(describe(message) + ": array \"" + header.name() + "\" has " + std::to_string(header.count()) +
               " rows instead of " + std::to_string(cell_count));
    return {{0, static_cast<std::int32_t>(cell_count)}};
}

}  // namespace

double empty_value(std::string const& field)
{
    return field == field::void_fraction ? 1.0 : 0.0;
}

struct FieldStore::Fields
{
    std::map<std::string, Field> of;
};

FieldStore::FieldStore() : fields_(std::make_shared<Fields>()) {}

Span<double const> FieldStore::receive(Message const& message, int k, std::size_t cell_count) const
{
    v1::ArrayHeader const& header = message.envelope.arrays(k);
    CellRuns const cells = cells_of(message, k, cell_count);
    Field& field = fields_->of[header.name()];
    unsigned const components = header.components();
    clear_others(field, cell_count * components, components, empty_value(header.name()), cells);

    void const* bytes = message.arrays[static_cast<std::size_t>(k)].data();
    if (header.compression() != v1::COMPRESSION_NONE)
    {
        decompress(header, message.arrays[static_cast<std::size_t>(k)], field.unpacked);
        bytes = field.unpacked.data();
    }
    bool const finite = header.type() == v1::ELEMENT_TYPE_F32
                            ? scatter(static_cast<float const*>(bytes), cells, components, field.values.data())
                            : scatter(static_cast<double const*>(bytes), cells, components, field.values.data());
    if (!finite) refuse_not_finite(message, header.name(), cells, components, field.values);
    return field.values;
}

}  // namespace gimdem::coupling::message
