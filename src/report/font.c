/* Tests if a font exists, as gnuplot replaces a missing font silently.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/base/utf8.h"
#include "core/system/subprocess.h"
#include "report/gnuplot.h"
#include "weartrack/report.h"

#include <string.h>
#include <strings.h>

/* Time limit of fc-match [s], which may first build its cache of fonts. */
static const double match_time = 10;

/* Escapes a name as a pattern, where a size would follow a hyphen. */
static void escape_font_pattern(const char *font, char pattern[2 * FONT_NAME_LIMIT + 1])
{
    for (; *font != '\0'; *pattern++ = *font++)
        if (*font == '-')
            *pattern++ = '\\';
    *pattern = '\0';
}

/* True if the font is one of the names of a family, "Noto Sans,Noto Sans Light". */
static bool family_contains(const char *names, const char *font)
{
    const size_t length = strlen(font);
    for (const char *name = names; name != NULL; name = strchr(name, ',')) {
        name += *name == ',';
        if (strcspn(name, ",") == length && strncasecmp(name, font, length) == 0)
            return true;
    }
    return false;
}

bool wt_report_font_is_available(const char *font, char *instead, size_t size)
{
    char pattern[2 * FONT_NAME_LIMIT + 1];
    if (font == NULL || strlen(font) > FONT_NAME_LIMIT || size == 0)
        return true;
    escape_font_pattern(font, pattern);
    const char *const arguments[] = {"-f", "%{family}\\n", pattern, NULL};
    const program_call call = {
        .program = "fc-match", .arguments = arguments, .folder = "/", .limit = match_time};
    program_result end;
    if (program_run(&call, &end, NULL) != WT_OK || end.outcome != PROGRAM_EXITED || end.code != 0 ||
        end.words[0] == '\0' || family_contains(end.words, font))
        return true;
    const size_t first = utf8_truncated_length(end.words, strcspn(end.words, ","), size - 1);
    memcpy(instead, end.words, first);
    instead[first] = '\0';
    return false;
}
