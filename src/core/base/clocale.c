/* Switches the locale of the calling thread to the C locale. SPDX-License-Identifier:
 * GPL-3.0-or-later */
#include "core/base/clocale.h"

#include <pthread.h>
#include <string.h>

static pthread_once_t once = PTHREAD_ONCE_INIT;
static locale_t c_locale = (locale_t)0;

static void create_c_locale(void)
{
    c_locale = newlocale(LC_ALL_MASK, "C", (locale_t)0);
}

locale_t clocale_enter(void)
{
    (void)pthread_once(&once, create_c_locale);
    /* uselocale((locale_t)0) changes nothing, which is right if the C locale could not be
     * created. */
    return uselocale(c_locale);
}

void clocale_leave(locale_t previous)
{
    (void)uselocale(previous);
}

int clocale_vprint(char *buffer, size_t size, const char *format, va_list arguments)
{
    const locale_t previous = clocale_enter();
    const int needed = vsnprintf(buffer, size, format, arguments);
    clocale_leave(previous);
    return needed;
}

void clocale_append(char *text, size_t size, const char *format, ...)
{
    const size_t used = strlen(text);
    va_list arguments;
    va_start(arguments, format);
    (void)clocale_vprint(text + used, size - used, format, arguments);
    va_end(arguments);
}

int clocale_print(char *buffer, size_t size, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    const int needed = clocale_vprint(buffer, size, format, arguments);
    va_end(arguments);
    return needed;
}
