/* Disables the GSL error handler, which aborts the program. SPDX-License-Identifier:
 * GPL-3.0-or-later */
#include "core/math/gsl_quiet.h"

#include <gsl/gsl_errno.h>
#include <pthread.h>

static void disable_gsl_handler(void)
{
    gsl_set_error_handler_off();
}

void gsl_quiet(void)
{
    static pthread_once_t once = PTHREAD_ONCE_INIT;
    pthread_once(&once, disable_gsl_handler);
}
