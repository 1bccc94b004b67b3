// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Tests of the C interface: capi_tests DATA WORK [PART]. DATA is docs/data, WORK a folder for
// files. A name of a part runs this one alone.
#include "support.h"

#include <stdio.h>
#include <string.h>

int main(int argc, char** argv) {
    const struct {
        const char* name;
        void (*run)(void);
    } parts[] = {{"basics", test_basics},
                 {"runs", test_runs},
                 {"surfaces", test_surfaces},
                 {"arrangement", test_arrangement},
                 {"sealing", test_sealing},
                 {"model", test_model},
                 {"reconstruction", test_reconstruction},
                 {"tetrahedra", test_tetrahedra},
                 {"verification", test_verification},
                 {"certificate", test_certificate},
                 {"project", test_project},
                 {"arguments", test_arguments},
                 {"forged_numbers", test_forged_numbers}};
    if (argc < 3) return 2;
    data_folder = argv[1];
    work_folder = argv[2];
    int run = 0;
    for (size_t i = 0; i < sizeof parts / sizeof parts[0]; ++i) {
        if (argc > 3 && strcmp(argv[3], parts[i].name) != 0) continue;
        parts[i].run();
        ++run;
    }
    if (run == 0) fprintf(stderr, "there is no such part\n");
    return run > 0 && failures() == 0 ? 0 : 1;
}
