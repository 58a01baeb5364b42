#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Usage: fetch-headers.sh [FOLDER]        (default: build/openfoam-headers of this checkout)
#
# Debian and Ubuntu ship OpenFOAM's libraries without its headers. They are in the source package that those
# libraries were built from; this gets it from the machine's own package mirror (45 MB), keeps the folders that
# gimdemFoam includes and links the headers of each into its lnInclude. Needs no root and changes nothing outside
# FOLDER. A second call does nothing. Where an OpenFOAM environment is sourced there is nothing to fetch.
#
# CMake reads the result from GIMDEM_OPENFOAM_HEADERS, which has the same default.
set -eu

root=$(cd "$(dirname "$0")/../.." && pwd)
folder=${1:-$root/build/openfoam-headers}
libraries="OpenFOAM OSspecific/POSIX finiteVolume meshTools fileFormats surfMesh"

fail() # problem (why) what to do
{
    echo "fetch-headers.sh: $*" >&2
    exit 1
}

if [ -n "${FOAM_SRC:-}" ] && [ -n "${FOAM_LIBBIN:-}" ]; then
    echo "OpenFOAM headers: those of the sourced environment, $FOAM_SRC"
    exit 0
fi

version=$(dpkg-query -W -f '${source:Version}' openfoam 2>/dev/null) && [ -n "$version" ] ||
    fail "the package openfoam is not installed (its headers must match its libraries); apt-get install openfoam," \
         "or source an OpenFOAM environment"
if [ "$(cat "$folder/version" 2>/dev/null)" = "$version" ]; then
    echo "OpenFOAM headers: $version in $folder"
    exit 0
fi

. /etc/os-release
codename=${VERSION_CODENAME:?"no VERSION_CODENAME in /etc/os-release"}
mkdir -p "$(dirname "$folder")"
work=$(mktemp -d "$folder.XXXXXX")
trap 'rm -rf "$work"' EXIT
trap 'exit 130' INT TERM
mkdir -p "$work/sources" "$work/lists/partial" "$work/cache/archives/partial" "$work/tree"

# The distribution's own package sources with "deb" turned into "deb-src", in both spellings that apt reads.
for list in /etc/apt/sources.list /etc/apt/sources.list.d/*.list; do
    [ -r "$list" ] || continue
    sed -n "/^[[:space:]]*deb[[:space:]].*[[:space:]]$codename/ s/^[[:space:]]*deb[[:space:]]/deb-src /p" "$list" \
        >> "$work/sources/one-line.list"
done
for list in /etc/apt/sources.list.d/*.sources; do
    [ -r "$list" ] || continue
    awk -v suite="$codename" 'BEGIN { RS = ""; ORS = "\n\n" }
        $0 ~ "(^|\n)Suites:[^\n]*" suite && $0 !~ /(^|\n)Enabled: *no/ {
            sub(/Types:[^\n]*/, "Types: deb-src"); print }' "$list" >> "$work/sources/$(basename "$list")"
done
find "$work/sources" -type f -size 0 -delete
if [ -z "$(ls "$work/sources")" ]; then
    case $ID in
        debian) mirror="http://deb.debian.org/debian $codename main" ;;
        ubuntu) mirror="http://archive.ubuntu.com/ubuntu $codename universe" ;;
        *) fail "no package source of $codename in /etc/apt (the headers come from there); add its deb line" ;;
    esac
    echo "deb-src $mirror" > "$work/sources/one-line.list"
fi

apt() # apt-get that sees only the sources above and writes only to $work
{
    apt-get -q -o Dir::Etc::SourceList=/dev/null -o Dir::Etc::SourceParts="$work/sources" \
        -o Dir::State::Lists="$work/lists" -o Dir::Cache="$work/cache" -o Debug::NoLocking=1 \
        -o Acquire::Languages=none -o APT::Sandbox::User=root "$@"
}

echo "OpenFOAM headers: fetching the source package openfoam $version ..."
apt update > "$work/log" 2>&1 || true # a foreign package source without sources is no fault; the next line decides
(cd "$work" && apt source --download-only "openfoam=$version" >> "$work/log" 2>&1) || {
    tail -n 5 "$work/log" >&2
    fail "the source package openfoam $version cannot be fetched (apt's words are above); check the network," \
         "or source an OpenFOAM environment"
}

tarball=$(ls "$work"/openfoam_*.orig.tar.*)
set --
for library in $libraries; do set -- "$@" "*/src/$library/*"; done
tar -xf "$tarball" -C "$work/tree" --strip-components=1 --wildcards "$@" '*/META-INFO/api-info' ||
    fail "$tarball cannot be unpacked (is bzip2 missing?); apt-get install bzip2"

for library in $libraries; do
    (cd "$work/tree/src/$library" && rm -rf lnInclude && mkdir lnInclude &&
        find . -name lnInclude -prune -o \( -name '*.[CH]' -o -name '*.[ch]' \) -type f -print | sed 's/^\.//' |
        while read -r file; do ln -sf "..$file" "lnInclude/${file##*/}"; done)
done

echo "$version" > "$work/tree/version"
rm -rf "$folder"
mv "$work/tree" "$folder"
echo "OpenFOAM headers: $version in $folder"
