// SPDX-License-Identifier: BSD-3-Clause
// Precompiled headers belong to a program; this one has nothing else.
int main() {}
