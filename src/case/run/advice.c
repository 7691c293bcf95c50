/* Extends advice that names an option by the spelling in a case file. SPDX-License-Identifier:
 * GPL-3.0-or-later */
#include "case/run/stage_functions.h"

#include "core/base/param.h"

#include <stdio.h>
#include <string.h>

static bool is_case_param(const wt_params *params, const char *name, size_t length)
{
    for (size_t i = 0; i < wt_params_count(params); i++) {
        const wt_param *p = wt_params_get(params, i);
        if ((p->flags & PARAM_NO_CASE) == 0 && strlen(p->name) == length &&
            strncmp(p->name, name, length) == 0)
            return true;
    }
    return false;
}

void flow_add_case_advice(wt_error *failure)
{
    static const char letters[] = "abcdefghijklmnopqrstuvwxyz-";
    const char *const option = strstr(failure->advice, "--");
    const char *const name = option != NULL ? option + 2 : "";
    const size_t length = strspn(name, letters), end = strlen(failure->advice);
    char hint[96] = "";
    if (strstr(failure->advice, "(in a case: ") != NULL)
        return; /* The advice concerns a file that an earlier step has reported already. */
    if (is_case_param(wt_read_params(), name, length))
        snprintf(hint, sizeof hint,
                 " (in a case: the attribute %.*s=\"...\" where the file is named)", (int)length,
                 name);
    else if (is_case_param(wt_master_job_params(), name, length))
        snprintf(hint, sizeof hint, " (in a case: <%.*s> in <dma>)", (int)length, name);
    if (strlen(hint) < sizeof failure->advice - end) /* truncated advice would be misleading */
        memcpy(failure->advice + end, hint, strlen(hint) + 1);
}
