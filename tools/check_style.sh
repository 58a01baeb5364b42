#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Formatting of the C++ sources and soundness of the scripts.
#
#   tools/check_style.sh [--fix]      --fix: format the sources instead of complaining
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

# OpenFOAM's sources keep OpenFOAM's own style.
mapfile -t sources < <(git ls-files '*.hpp' '*.cpp' '*.cu' '*.h' ':!cfd-client/openfoam')

if [[ ${1:-} == --fix ]]; then
    clang-format -i "${sources[@]}"
elif command -v clang-format >/dev/null; then
    clang-format --dry-run --Werror "${sources[@]}"
    echo "format: ${#sources[@]} files are clean"
else
    echo "format: not checked (clang-format is not installed)"
fi

if command -v shellcheck >/dev/null; then
    mapfile -t scripts < <(git ls-files gimdem .ci/run '*.sh')
    shellcheck --severity=warning "${scripts[@]}"
    echo "shellcheck: ${#scripts[@]} scripts are clean"
else
    echo "shellcheck: not run (not installed)"
fi
