#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Install the packages of packages.txt that are missing, then fetch OpenFOAM's headers. Does nothing where all is there.
#
#   tools/setup.sh [--quiet]      --quiet: say nothing where nothing is to be done
set -euo pipefail

here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
quiet=${1:-}
fetch_headers=$here/../cfd-client/openfoam/fetch-headers.sh

inform() { [[ $quiet == --quiet ]] || echo "setup: $*"; }

has_openfoam_environment() { [[ -n ${FOAM_SRC:-} && -n ${FOAM_LIBBIN:-} ]]; }

wanted_packages() {
    local line name
    while read -r line; do
        name=${line%%#*}
        name=${name//[[:space:]]/}
        [[ -n $name ]] || continue
        if [[ $name == openfoam ]] && has_openfoam_environment; then continue; fi
        echo "$name"
    done <"$here/packages.txt"
}

missing_packages() {
    local wanted installed
    wanted=$(wanted_packages | sort)
    # shellcheck disable=SC2086  # one word per package
    installed=$(dpkg-query -W -f '${db:Status-Status} ${Package}\n' $wanted 2>/dev/null |
        sed -n 's/^installed //p' | sort -u) || true
    comm -23 <(echo "$wanted") <(echo "$installed")
}

# Run as root: directly, or through sudo where it needs no password or somebody can type one.
as_root() {
    if [[ $(id -u) -eq 0 ]]; then
        "$@"
    elif command -v sudo >/dev/null && { sudo -n true 2>/dev/null || [[ -t 0 && -t 2 ]]; }; then
        sudo "$@"
    else
        return 1
    fi
}

# Install "${missing[@]}"; on failure print the one command that somebody with root has to run.
install_missing() {
    local install=(apt-get install --yes --no-install-recommends "${missing[@]}")
    local log
    log=$(mktemp "${TMPDIR:-/tmp}/gimdem-apt.XXXXXX")
    echo "setup:    installing ${#missing[@]} packages with apt: ${missing[*]}" >&2
    # shellcheck disable=SC2016  # $@ is for the inner shell
    if as_root env DEBIAN_FRONTEND=noninteractive sh -c 'apt-get update && exec "$@"' apt "${install[@]}" \
        >"$log" 2>&1 </dev/null; then
        rm -f "$log"
        mapfile -t missing < <(missing_packages)
        [[ ${#missing[@]} -gt 0 ]] || return 0
        echo "gimdem: error: apt ran, but these packages are still missing: ${missing[*]}" >&2
    elif [[ -s $log ]]; then
        tail -n 5 "$log" >&2
        echo "gimdem: error: apt could not install what gimdem needs (the whole log is $log); mend that, or run:" >&2
    else
        rm -f "$log"
        echo "gimdem: error: packages are missing, and installing them needs root (you are not, and sudo cannot be" \
            "used here); have this run once:" >&2
    fi
    echo "  sudo sh -c 'apt-get update && ${install[*]}'" >&2
    return 1
}

if command -v dpkg-query >/dev/null; then
    mapfile -t missing < <(missing_packages)
    if [[ ${#missing[@]} -gt 0 ]]; then install_missing; fi
    inform "all packages are installed"
else
    inform "no dpkg here (only Debian's and Ubuntu's packages can be installed); going on with what there is"
fi

if ! has_openfoam_environment && [[ -f $fetch_headers ]]; then
    if ! answer=$(sh "$fetch_headers" 2>&1); then
        echo "$answer" >&2
        echo "gimdem: error: OpenFOAM's headers are absent (the client is built with them); see the lines above" >&2
        exit 1
    fi
    inform "$answer"
fi
