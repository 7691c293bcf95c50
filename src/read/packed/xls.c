/* Old Excel files (BIFF) through FreeXL. That library opens a file by its name and trusts what it
 * finds, so it works behind the door, on the bytes as they were read.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "base/array.h"
#include "base/clocale.h"
#include "base/door.h"
#include "read/packed/packed.h"

#include <errno.h>
#include <freexl.h>
#include <limits.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

#define MIB ((size_t)1 << 20)

bool xls_is(const unsigned char *bytes, size_t length)
{
    static const unsigned char signature[8] = {0xd0, 0xcf, 0x11, 0xe0, 0xa1, 0xb1, 0x1a, 0xe1};
    return length >= sizeof signature && memcmp(bytes, signature, sizeof signature) == 0;
}

/* ---- behind the door ------------------------------------------------------------------------- */

/* What is said of a sheet: SHEET name, then a CELL row, column, text for each, ended by zeros. */
enum { SHEET = 'S', CELL = 'C' };

static void print_cell(FILE *out, unsigned row, unsigned column, const FreeXL_CellValue *cell)
{
    char number[40] = "";
    const char *text = number;
    switch (cell->type) {
    case FREEXL_CELL_INT:
        (void)snprintf(number, sizeof number, "%d", cell->value.int_value);
        break;
    case FREEXL_CELL_DOUBLE:
        (void)snprintf(number, sizeof number, "%.15g", cell->value.double_value);
        if (strtod(number, NULL) < cell->value.double_value ||
            strtod(number, NULL) > cell->value.double_value)
            (void)snprintf(number, sizeof number, "%.17g", cell->value.double_value);
        break;
    case FREEXL_CELL_TEXT:
    case FREEXL_CELL_SST_TEXT:
    case FREEXL_CELL_DATE:
    case FREEXL_CELL_DATETIME:
    case FREEXL_CELL_TIME:
        text = cell->value.text_value != NULL ? cell->value.text_value : "";
        break;
    default:
        break;
    }
    if (*text != '\0')
        (void)fprintf(out, "%c%u %u %s%c", CELL, row, column, text, '\0');
}

static wt_status print_sheet(const void *book, unsigned short i, FILE *out, wt_error *err)
{
    unsigned rows = 0;
    unsigned short columns = 0;
    const char *name = NULL;
    FreeXL_CellValue cell;
    if (freexl_get_worksheet_name(book, i, &name) != FREEXL_OK ||
        freexl_select_active_worksheet(book, i) != FREEXL_OK ||
        freexl_worksheet_dimensions(book, &rows, &columns) != FREEXL_OK)
        return wt_fail(err, WT_E_CORRUPT, "a sheet of the spreadsheet cannot be read");
    (void)fprintf(out, "%c%s%c", SHEET, name != NULL ? name : "", '\0');
    for (unsigned r = 0; r < rows; r++)
        for (unsigned short c = 0; c < columns; c++)
            if (freexl_get_cell_value(book, r, c, &cell) == FREEXL_OK)
                print_cell(out, r, c, &cell);
    return WT_OK;
}

static wt_status print_book(const door_call *door, FILE *out, wt_error *err)
{
    (void)door;
    char path[32];
    const void *book = NULL;
    unsigned n = 0, locked = 0;
    (void)snprintf(path, sizeof path, "/proc/self/fd/%d", (int)DOOR_FILE);
    const int how = freexl_open(path, &book);
    if (how != FREEXL_OK || freexl_get_info(book, FREEXL_BIFF_SHEET_COUNT, &n) != FREEXL_OK ||
        n == 0) {
        wt_fail(err, WT_E_FORMAT, "no spreadsheet that can be read");
        wt_error_found(err, "an old Excel or Word file that is damaged, or of another program");
        wt_error_advice(err, "save it as .xlsx, CSV or text");
        return WT_E_FORMAT;
    }
    if (freexl_get_info(book, FREEXL_BIFF_PASSWORD, &locked) == FREEXL_OK &&
        locked == FREEXL_BIFF_OBFUSCATED) {
        wt_fail(err, WT_E_UNSUPPORTED, "the spreadsheet is protected by a password");
        wt_error_advice(err, "save it without one");
        return WT_E_UNSUPPORTED;
    }
    wt_status status = WT_OK;
    const locale_t previous = clocale_enter();
    for (unsigned i = 0; i < n && i < USHRT_MAX && status == WT_OK; i++)
        status = print_sheet(book, (unsigned short)i, out, err);
    clocale_leave(previous);
    return status;
}

/* ---- in front of it -------------------------------------------------------------------------- */

/* One cell of the answer: row and column may be anything. */
static wt_status take_cell(sheet_text *text, const char *record, const char *name, wt_error *err)
{
    char *end = NULL;
    const size_t row = strtoul(record, &end, 10);
    const size_t column = *end == ' ' ? strtoul(end, &end, 10) : SIZE_MAX;
    const bool rises = row > text->row || (row == text->row && column >= text->column);
    if (*end != ' ' || !rises || row > UINT_MAX || column > USHRT_MAX)
        return wt_fail(err, WT_E_CORRUPT, "the cells of the spreadsheet are in no order");
    return sheet_put(text, row, column, end + 1, strlen(end + 1)) ? WT_OK
                                                                  : sheet_refuse(text, name, err);
}

static wt_status take_answer(const char *answer, size_t length, size_t most, workbook *book,
                             wt_error *err)
{
    const char *name = NULL;
    sheet_text text = {.most = workbook_room(book, most)};
    wt_status status = WT_OK;
    for (size_t at = 0; status == WT_OK && at < length; at += strlen(answer + at) + 1) {
        const bool whole = memchr(answer + at, '\0', length - at) != NULL;
        const char *record = answer + at;
        if (!whole || (*record != SHEET && (*record != CELL || name == NULL))) {
            status = wt_fail(err, WT_E_CORRUPT, "the spreadsheet library answers nonsense");
        } else if (*record == CELL) {
            status = take_cell(&text, record + 1, name, err);
        } else {
            if (name != NULL)
                status = workbook_add(book, name, false, &text, err);
            text = status == WT_OK ? (sheet_text){.most = workbook_room(book, most)} : text;
            name = record + 1;
        }
        if (status != WT_OK)
            break;
    }
    if (status == WT_OK && name != NULL)
        status = workbook_add(book, name, false, &text, err);
    free(text.bytes);
    return status;
}

/* A file without a name that holds the bytes; -1 and errno if there is none. */
static int file_of(const unsigned char *bytes, size_t length)
{
    const int fd = memfd_create("weartrack-xls", MFD_CLOEXEC);
    size_t done = 0;
    while (fd >= 0 && done < length) {
        const ssize_t n = write(fd, bytes + done, length - done);
        if (n < 0 && errno == EINTR)
            continue;
        if (n <= 0) {
            const int number = errno;
            (void)close(fd);
            errno = number;
            return -1;
        }
        done += (size_t)n;
    }
    return fd;
}

wt_status xls_read(wt_input *input, workbook *book, wt_error *err)
{
    const unsigned char *bytes = NULL;
    char *answer = NULL;
    size_t length = 0, n = 0;
    wt_status status = wt_input_bytes(input, &bytes, &length, err);
    if (status != WT_OK)
        return status;
    const door_limits limits = door_limits_of(length);
    const door_call door = {.what = "XLS",
                            .reading = print_book,
                            .bytes = bytes,
                            .size = length,
                            .file = file_of(bytes, length),
                            .opens_again = true};
    if (door.file < 0)
        return wt_fail(err, errno == ENOMEM ? WT_E_MEMORY : WT_E_IO,
                       "no file in memory for the spreadsheet: %s", strerror(errno));
    status = door_read(&door, &limits, &answer, &n, err);
    (void)close(door.file);
    if (status == WT_OK)
        status = take_answer(answer, n, 16 * MIB + 8 * length, book, err);
    free(answer);
    if (status != WT_OK)
        workbook_clear(book);
    return status;
}
