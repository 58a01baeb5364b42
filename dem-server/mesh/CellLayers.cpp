// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <vector>

#include "mesh/PolyMesh.hpp"

namespace gimdem
{

CellLayers::CellLayers(PolyMesh const& mesh)
{
    MeshKernelView const view = mesh.view();
    std::vector<std::int32_t> all;
    std::vector<std::int32_t> seen_by(static_cast<std::size_t>(mesh.cell_count()), -1);
    offsets.resize(mesh.cell_count() + 1);
    for (std::int32_t c = 0; c < mesh.cell_count(); ++c)
    {
        offsets[c] = static_cast<std::int32_t>(all.size());
        auto const add = [&](std::int32_t cell)
        {
            if (cell < 0 || seen_by[static_cast<std::size_t>(cell)] == c) return;
            seen_by[static_cast<std::size_t>(cell)] = c;
            all.push_back(cell);
        };
        auto const add_neighbours = [&](std::int32_t cell)
        {
            for (std::int32_t const f : mesh.faces_of_cell(cell))
                add(view.across(f, cell));
        };
        add(c);
        add_neighbours(c);
        std::size_t const first_layer_end = all.size();
        for (auto k = static_cast<std::size_t>(offsets[c]) + 1; k < first_layer_end; ++k)
            add_neighbours(all[k]);
    }
    offsets[mesh.cell_count()] = static_cast<std::int32_t>(all.size());
    cells.resize(static_cast<std::int64_t>(all.size()));
    std::copy(all.begin(), all.end(), cells.host().begin());
}

}  // namespace gimdem
