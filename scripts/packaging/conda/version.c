// SPDX-License-Identifier: LGPL-3.0-or-later
#include <stdio.h>

#include <terrane/terrane.h>

int main(void) {
    printf("terrane %s\n", terrane_version());
    return terrane_abi_version() == TERRANE_ABI_VERSION ? 0 : 1;
}
