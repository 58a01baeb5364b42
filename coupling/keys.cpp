// SPDX-License-Identifier: BSD-3-Clause
/// gimdem-keys: makes a folder of keys. Usage: gimdem-keys DIR
/// Exit codes: 0 made; 1 not made; 2 wrong usage.
#include <exception>
#include <iostream>

#include "gimdem/coupling/Keys.hpp"

int main(int argc, char** argv)
{
    if (argc != 2 || *argv[1] == '-' || *argv[1] == 0)
    {
        std::cerr << "usage: gimdem-keys DIR\n";
        return 2;
    }
    try
    {
        gimdem::coupling::make_keys(argv[1]);
        return 0;
    }
    catch (std::exception const& error)
    {
        std::cerr << "gimdem: error: " << error.what() << '\n';
        return 1;
    }
}
