/* Records resource errors of libraries: out of memory, or no access to a file.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/base/resource_error.h"

#include <errno.h>
#include <string.h>

static _Thread_local int seen; /* errno of the last resource error; 0 without one */

void resource_error_clear(void)
{
    seen = 0;
}

void resource_error_note(int number)
{
    seen = number;
}

wt_status resource_error_fail(int number, wt_error *err)
{
    resource_error_note(number);
    if (number == ENOMEM)
        return wt_fail(err, WT_E_MEMORY, "out of memory");
    if (number == EMFILE || number == ENFILE) {
        (void)wt_fail(err, WT_E_INTERNAL, "a file that reading needs cannot be opened: %s",
                      strerror(number));
        wt_error_advice(err, MORE_FILES_ADVICE);
        return WT_E_INTERNAL;
    }
    (void)wt_fail(err, WT_E_INTERNAL, "the units database of UDUNITS-2 cannot be read%s%s",
                  number > 0 ? ": " : "", number > 0 ? strerror(number) : "");
    wt_error_advice(err, "install it, or name it in the variable UDUNITS2_XML_PATH");
    return WT_E_INTERNAL;
}

wt_status resource_error_finish(wt_status status, wt_error *err)
{
    return seen != 0 ? resource_error_fail(seen, err) : status;
}
