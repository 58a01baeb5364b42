// SPDX-License-Identifier: BSD-3-Clause
/// client.h in C++, with the headers of the C++ client beside it. It only has to compile and link.
#include "gimdem/coupling/client.h"

#include "gimdem/coupling/Client.hpp"

int main()
{
    return gimdem_client_destroy(nullptr);
}
