// SPDX-License-Identifier: BSD-3-Clause
#include "walls/WallContacts.hpp"

#include <algorithm>

#include "exec/ForEach.hpp"
#include "exec/Reduce.hpp"
#include "walls/WallKernels.hpp"

namespace gimdem
{

WallContacts::WallContacts(exec::Execution execution, Materials const& materials, int wall_material,
                           WallGeometry const& walls)
    : execution_(execution), model_(materials), walls_(walls)
{
    poses_.resize(walls.body_count());
    first_pair_.resize(walls.body_count());
    for (std::int32_t b = 0; b < walls.body_count(); ++b)
    {
        std::string const& name = walls.material(b);
        first_pair_[b] = (name.empty() ? wall_material : materials.number_of(name)) * materials.count();
        poses_[b] = walls.motion(b).at(0);
        some_wall_moves_ |= walls.motion(b).moves();
    }
}

void WallContacts::add_forces(ParticleState& particles, double dt)
{
    WallFinder const find{
        {nearby(), pairs_.plane.view().data, pairs_.whole.view().data},
        {pairs_.displacement.view().data, model_.has_rolling_spring() ? pairs_.rolling_spring.view().data : nullptr},
        particles.position.view().data,
        pairs_.offsets.view().data,
        touches_.view().data};
    wall_force_.resize(near_.size());
    model_.visit(
        [&]<class Law>(LawTable<Law> const& table)
        {
            exec::for_each(execution_, near_.size(),
                           WallKernel<Law>{particles.view(), find, near_.view().data, table.constants.view().data,
                                           first_pair_.view().data, dt, wall_force_.view().data});
        });
    Quad const* const force = wall_force_.view().data;
    total_force_ = exec::reduce(
        execution_, wall_force_.size(), Quad{0, 0, 0, 0}, [=](std::int64_t n) { return force[n]; },
        [](Quad const& a, Quad const& b) { return a + b; });
}

Quad WallContacts::force_on(std::int64_t particle) const
{
    auto const near = near_.host();
    auto const place = std::lower_bound(near.begin(), near.end(), particle);
    return place != near.end() && *place == particle ? wall_force_[place - near.begin()] : Quad{0, 0, 0, 0};
}

}  // namespace gimdem
