/* Fuzz target: any bytes as a case file. A case that passes the checks is planned.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "case/case.h"

#include <stdlib.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    wt_case *c = NULL;
    wt_table *plan = NULL;
    wt_error err = WT_ERROR_INIT;
    if (case_from_bytes(data, size, "folder/fuzz.xml", &c, &err) != WT_OK)
        return 0;
    if (wt_plan(c, &plan, &err) != WT_OK)
        abort();
    wt_table_free(plan);
    wt_case_free(c);
    return 0;
}
