// SPDX-License-Identifier: BSD-3-Clause
#include "core/CaseSettings.hpp"
#include "core/CaseTable.hpp"

namespace gimdem
{

using namespace case_file;

// clang-format off

Fields<WallItemSettings> const& settings_of(WallItemSettings const&)
{
    using S = WallItemSettings;
    static Fields<S> const fields = {
        required("name",      &S::name,      "", not_empty(), "\"drum\"", "what messages call it"),
        required("shape",     &S::shape,     "", one_of({"plane", "cylinder", "stl"}), "\"plane\"",
                 "plane: infinite; cylinder: a tube without lids; stl: the triangles of a file"),
        optional("material",  &S::material,  "", not_empty(), "\"steel\"",
                 "what it is made of; where not given that of [walls]"),
        optional("point",     &S::point,     "m", anything(), "[0.0, 0.0, 0.0]",
                 "plane: any of its points; cylinder: a point of its axis, where it begins if it has a length"),
        optional("normal",    &S::normal,    "", anything(), "[0.0, 0.0, 1.0]",
                 "plane: direction towards the particles, of any length"),
        optional("axis",      &S::axis,      "", anything(), "[0.0, 1.0, 0.0]",
                 "cylinder: direction of its axis, of any length"),
        optional("radius",    &S::radius,    "m", above(0), "0.05", "cylinder: of the wall"),
        optional("length",    &S::length,    "m", above(0), "0.1",
                 "cylinder: from point along axis; where not given it is infinite"),
        optional("inside",    &S::inside,    "", anything(), "true",
                 "cylinder, closed stl: the particles are inside (true) or around it (false)"),
        optional("file",      &S::file,      "", anything(), "\"drum.stl\"",
                 "stl: ASCII or binary, triangles anticlockwise seen from outside, beside the case file"),
        optional("scale",     &S::scale,     "", above(0), "0.001", "stl: metres per unit of the file"),
        optional("open",      &S::open,      "", anything(), "true",
                 "stl: a sheet with rims, which stops particles on both sides"),
        optional("velocity",  &S::velocity,  "m/s", anything(), "[0.1, 0.0, 0.0]", "translation from time 0 on"),
        optional("rotation",  &S::rotation,  "the wall turns from time 0 on"),
        optional("vibration", &S::vibration, "the wall vibrates about where it was put"),
    };
    return fields;
}

Fields<WallRotationSettings> const& settings_of(WallRotationSettings const&)
{
    using S = WallRotationSettings;
    static Fields<S> const fields = {
        required("axis",   &S::axis,   "", anything(), "[0.0, 1.0, 0.0]", "direction of the axis, of any length"),
        optional("origin", &S::origin, "m", anything(), "[0.0, 0.0, 0.0]", "a point of the axis; moves with the wall"),
        required("speed",  &S::speed,  "rad/s", anything(), "3.0", "right-handed about axis"),
    };
    return fields;
}

Fields<WallVibrationSettings> const& settings_of(WallVibrationSettings const&)
{
    using S = WallVibrationSettings;
    static Fields<S> const fields = {
        required("direction", &S::direction, "", anything(), "[0.0, 0.0, 1.0]", "of the motion, of any length"),
        required("amplitude", &S::amplitude, "m", at_least(0), "1e-3", "half the stroke"),
        required("frequency", &S::frequency, "Hz", at_least(0), "50.0", "strokes to and fro per second"),
        optional("phase",     &S::phase,     "rad", anything(), "1.5708",
                 "at time 0: the displacement is amplitude times the sine of it"),
    };
    return fields;
}

// clang-format on

}  // namespace gimdem
