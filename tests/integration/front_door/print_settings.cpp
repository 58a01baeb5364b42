// SPDX-License-Identifier: BSD-3-Clause
/// print_settings > docs/case-file.md: what the settings in the code say of themselves.
#include <iostream>

#include "core/Case.hpp"

int main()
{
    std::cout << gimdem::settings_as_markdown();
}
