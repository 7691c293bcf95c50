/* Memory of friction records. SPDX-License-Identifier: GPL-3.0-or-later */
#include "weartrack/core.h"

#include <stdlib.h>

void wt_record_clear(wt_record *record)
{
    if (record == NULL)
        return;
    for (int c = 0; c < WT_RECORD_CHANNELS; c++)
        free(record->channel[c]);
    free(record->step);
    *record = (wt_record){.n = 0};
}
