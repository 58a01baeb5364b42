// SPDX-License-Identifier: BSD-3-Clause
/// The tables of all settings of a case file: key, member, unit, range, example, purpose.
#pragma once

#include "core/Case.hpp"
#include "core/CaseReader.hpp"

namespace gimdem
{

case_file::Fields<Case> const& settings_of(Case const&);
case_file::Fields<RunSettings> const& settings_of(RunSettings const&);
case_file::Fields<CouplingSettings> const& settings_of(CouplingSettings const&);
case_file::Fields<DemSettings> const& settings_of(DemSettings const&);
case_file::Fields<MaterialSettings> const& settings_of(MaterialSettings const&);
case_file::Fields<ContactSettings> const& settings_of(ContactSettings const&);
case_file::Fields<WallSettings> const& settings_of(WallSettings const&);
case_file::Fields<WallItemSettings> const& settings_of(WallItemSettings const&);
case_file::Fields<WallRotationSettings> const& settings_of(WallRotationSettings const&);
case_file::Fields<WallVibrationSettings> const& settings_of(WallVibrationSettings const&);
case_file::Fields<DomainSettings> const& settings_of(DomainSettings const&);
case_file::Fields<SizeSettings> const& settings_of(SizeSettings const&);
case_file::Fields<InsertionSettings> const& settings_of(InsertionSettings const&);
case_file::Fields<InletSettings> const& settings_of(InletSettings const&);
case_file::Fields<SettleSettings> const& settings_of(SettleSettings const&);
case_file::Fields<FluidForceSettings> const& settings_of(FluidForceSettings const&);
case_file::Fields<MappingSettings> const& settings_of(MappingSettings const&);
case_file::Fields<PlaneSettings> const& settings_of(PlaneSettings const&);
case_file::Fields<OutputSettings> const& settings_of(OutputSettings const&);

}  // namespace gimdem
