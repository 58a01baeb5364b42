// SPDX-License-Identifier: BSD-3-Clause
/// A small case that is right in everything, for tests to break.
#pragma once

#include <stdexcept>
#include <string>

namespace gimdem::test
{

// clang-format off
inline std::string const good_case =
    "title = \"small\"\n"                                   //  1
    "[run]\n"                                               //  2
    "until = 1.0\n"                                         //  3
    "grid = \"B\"\n"                                        //  4
    "grids = [\"A\", \"B\"]\n"                              //  5
    "[coupling]\n"                                          //  6
    "schedule = \"serial\"\n"                               //  7
    "endpoint = \"ipc\"\n"                                  //  8
    "timeout = 30.0\n"                                      //  9
    "[dem]\n"                                               // 10
    "time_step = 2.5e-5\n"                                  // 11
    "gravity = [0.0, 0.0, -9.81]\n"                         // 12
    "threads = 2\n"                                         // 13
    "backend = \"serial\"\n"                                // 14
    "skin = 0.2\n"                                          // 15
    "[[materials]]\n"                                       // 16
    "name = \"bead\"\n"                                     // 17
    "density = 1150.0\n"                                    // 18
    "young_modulus = 1.2e5\n"                               // 19
    "poisson_ratio = 0.33\n"                                // 20
    "[[materials]]\n"                                       // 21
    "name = \"steel\"\n"                                    // 22
    "density = 7800\n"                                      // 23
    "young_modulus = 2e7\n"                                 // 24
    "poisson_ratio = 0.3\n"                                 // 25
    "[[contacts]]\n"                                        // 26
    "pair = [\"bead\", \"bead\"]\n"                         // 27
    "restitution = 0.9\n"                                   // 28
    "friction = 0.3\n"                                      // 29
    "[[contacts]]\n"                                        // 30
    "pair = [\"steel\", \"bead\"]\n"                        // 31
    "restitution = 0.8\n"                                   // 32
    "friction = 0.1\n"                                      // 33
    "[walls]\n"                                             // 34
    "material = \"steel\"\n"                                // 35
    "[[insertion]]\n"                                       // 36
    "material = \"bead\"\n"                                 // 37
    "diameter = 1.5e-3\n"                                   // 38
    "count = 100\n"                                         // 39
    "box = [[0.0, 0.0, 0.0], [0.09, 0.008, 0.5]]\n"         // 40
    "spacing = 1.65e-3\n"                                   // 41
    "jitter = 2e-5\n"                                       // 42
    "[settle]\n"                                            // 43
    "duration = 0.5\n"                                      // 44
    "[mapping]\n"                                           // 45
    "method = \"gim\"\n"                                    // 46
    "void_fraction_minimum = 0.1\n"                         // 47
    "[output]\n"                                            // 48
    "sample_interval = 1e-3\n"                              // 49
    "planes = [{ name = \"low\", point = [0, 0, 0.045], normal = [0, 0, 1] }]\n"  // 50
    "inlet = \"inlet\"\n"                                   // 51
    "outlet = \"outlet\"\n";                                // 52
// clang-format on

/// `text` with its first `before` replaced.
inline std::string with(std::string text, std::string const& before, std::string const& after)
{
    auto const at = text.find(before);
    if (at == std::string::npos) throw std::invalid_argument("the case has no " + before);
    return text.replace(at, before.size(), after);
}

}  // namespace gimdem::test
