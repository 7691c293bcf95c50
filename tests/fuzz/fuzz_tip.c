/* Fuzz target: any text as a tip. An accepted tip passes the check and has a table of forces, or
 * the error states the reason.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "weartrack/indentation.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    char *const text = strndup((const char *)data, size), words[200];
    wt_tip tip;
    wt_error err = WT_ERROR_INIT;
    wt_contact_table *table = NULL;
    if (text == NULL)
        abort();
    if (wt_tip_parse(text, &tip, &err) == WT_OK) {
        if (wt_tip_check(&tip, &err) != WT_OK || wt_tip_describe(&tip, words, sizeof words) == 0)
            abort();
        if (wt_contact_table_new(&tip, 1e-10, 1e-6, &table, &err) != WT_OK &&
            err.message[0] == '\0')
            abort();
    } else if (err.message[0] == '\0') {
        abort();
    }
    wt_contact_table_free(table);
    free(text);
    return 0;
}
