/* Answers without memory. SPDX-License-Identifier: GPL-3.0-or-later */
#include "base/shortage.h"

static _Thread_local bool seen;

void shortage_forget(void)
{
    seen = false;
}

void shortage_note(void)
{
    seen = true;
}

wt_status shortage_end(wt_status status, wt_error *err)
{
    if (!seen)
        return status;
    return wt_fail(err, WT_E_MEMORY, "out of memory");
}
