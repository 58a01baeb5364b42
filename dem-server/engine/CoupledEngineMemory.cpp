// SPDX-License-Identifier: BSD-3-Clause
/// What CoupledEngine must know to repeat a coupling step, theory.md (C.15).
#include "engine/CoupledEngine.hpp"
#include "engine/StepMemory.hpp"

namespace gimdem
{

CoupledEngine::~CoupledEngine() = default;

void CoupledEngine::remember()
{
    if (memory_ == nullptr) memory_ = std::make_unique<StepMemory>();
    StepMemory& memory = *memory_;
    system_.remember(memory.dem);
    if (DeviceDem* const device = system_.device())
        device->download_cells(memory.cell_of);
    else
        memory.cell_of = mapper_.cell_of();
    memory.void_fraction = void_fraction_;
    if (mapper_.reuse() != nullptr) memory.reference = mapper_.reuse()->reference();
    memory.inlets.clear();
    if (inlets_ != nullptr)
        for (Inlet const& inlet : *inlets_)
            memory.inlets.push_back(inlet.state());
    memory.clips = particle_clips();
}

void CoupledEngine::go_back()
{
    StepMemory const& memory = *memory_;
    clips_given_up_ += particle_clips() - memory.clips;
    system_.go_back(memory.dem);
    mapper_.take_cells(memory.cell_of);
    void_fraction_ = memory.void_fraction;
    if (mapper_.reuse() != nullptr) mapper_.reuse()->restore(memory.reference);
    for (std::size_t i = 0; i < memory.inlets.size(); ++i)
        (*inlets_)[i].restore(memory.inlets[i]);
    if (DeviceDem* const device = system_.device())
    {
        device->upload_cells(memory.cell_of);
        device->set_void_fraction(void_fraction_);
    }
}

}  // namespace gimdem
