// SPDX-License-Identifier: BSD-3-Clause
#include "walls/WallContacts.hpp"

#include "exec/ForEach.hpp"
#include "exec/Reduce.hpp"
#include "walls/WallKernel.hpp"

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
    if (particles.count() == 0) force_.resize(0);  // nobody is left, and no list was built
    WallFinder const find{nearby(), pairs_view(),
                          WallSprings{pairs_.displacement.view().data,
                                      model_.has_rolling_spring() ? pairs_.rolling_spring.view().data : nullptr},
                          particles.position.view().data, force_.view().data};
    model_.visit(
        [&]<class Law>(LawTable<Law> const& table)
        {
            using Kernel = WallKernel<Law>;
            exec::for_each_uneven(execution_, (particles.count() + Kernel::block - 1) / Kernel::block,
                                  Kernel{particles.view(), find, table.constants.view().data, dt});
        });
    Quad const* const force = force_.view().data;
    total_force_ = exec::reduce(
        execution_, force_.size(), Quad{0, 0, 0, 0}, [=](std::int64_t k) { return force[k]; },
        [](Quad const& a, Quad const& b) { return a + b; });
}

void WallContacts::go_back(Memory const& memory)
{
    time_ = memory.time;
    built_time_ = memory.built_time;
    poses_ = memory.poses;
    built_at_ = memory.built_at;
    low_ = memory.low;
    high_ = memory.high;
    pairs_ = memory.pairs;
    force_ = memory.force;
    total_force_ = memory.total_force;
}

WallPairsView WallContacts::pairs_view()
{
    return {pairs_.offsets.view().data, pairs_.particle.view().data, pairs_.plane.view().data, pairs_.row.view().data,
            pairs_.whole.view().data,   pairs_.alone.view().data,    touches_.view().data};
}

Quad WallContacts::force_on(std::int64_t particle) const
{
    Quad sum{0, 0, 0, 0};
    for (std::int32_t k = pairs_.offsets[particle]; k < pairs_.offsets[particle + 1]; ++k)
        sum = sum + force_[k];
    return sum;
}

}  // namespace gimdem
