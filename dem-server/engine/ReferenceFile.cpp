// SPDX-License-Identifier: BSD-3-Clause
#include "engine/ReferenceFile.hpp"

#include <algorithm>
#include <vector>

#include "core/Error.hpp"

namespace gimdem
{

void add_reference(output::SnapshotWriter& writer, WeightReference const& reference)
{
    std::vector<double> places;
    for (Quad const& x : reference.particles.position.host())
        places.insert(places.end(), {x.x, x.y, x.z, x.w});
    writer.add("weights_of_place", places, 4);
    writer.add("weights_of_cell", reference.cell.host());
}

WeightReference reference_of(output::SnapshotReader const& reader)
{
    auto const places = reader.doubles("weights_of_place");
    auto const cells = reader.int32s("weights_of_cell");
    std::size_t const count = reader.int64s("id").size();
    if (cells.size() != count || places.size() != 4 * count)
        throw UserError(
            "the state's arrays do not fit each other (there are not as many places of weights as particles); nothing "
            "was taken from it");

    WeightReference reference;
    reference.cell.resize(std::ssize(cells));
    std::ranges::copy(cells, reference.cell.host().begin());
    reference.particles.position.resize(std::ssize(cells));
    for (std::size_t p = 0; p < count; ++p)
        reference.particles.position[static_cast<std::int64_t>(p)] = {places[4 * p], places[4 * p + 1],
                                                                      places[4 * p + 2], places[4 * p + 3]};
    return reference;
}

}  // namespace gimdem
