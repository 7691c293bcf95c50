/* Decodes bytes of the usual encodings to UTF-8 lines. SPDX-License-Identifier: GPL-3.0-or-later */
#include "read/text/text.h"

#include "core/base/memory.h"
#include "core/base/text.h"

#include <errno.h>
#include <fcntl.h>
#include <iconv.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

typedef enum byte_order { ORDER_NONE, ORDER_LITTLE, ORDER_BIG } byte_order;

/* Guesses the byte order. Text of mostly Latin letters has a zero in every other byte. */
static byte_order guess_utf_16(const unsigned char *bytes, size_t length)
{
    size_t even = 0, odd = 0;
    const size_t n = length < 1024 ? length : 1024;
    for (size_t i = 0; i < n; i++) {
        even += i % 2 == 0 && bytes[i] == 0;
        odd += i % 2 == 1 && bytes[i] == 0;
    }
    if (4 * odd > n && even < odd)
        return ORDER_LITTLE;
    if (4 * even > n && odd < even)
        return ORDER_BIG;
    return ORDER_NONE;
}

typedef struct encoding_choice {
    const char *words; /* for messages */
    const char *iconv; /* name for iconv; NULL for UTF-8 */
    size_t mark;       /* size of the byte order mark [byte] */
    bool utf_16;
} encoding_choice;

static encoding_choice choose_encoding(const unsigned char *bytes, size_t length,
                                       text_encoding encoding)
{
    const bool any = encoding == ENCODING_AUTO;
    if ((any || encoding == ENCODING_UTF_8) && length >= 3 && memcmp(bytes, "\xef\xbb\xbf", 3) == 0)
        return (encoding_choice){"UTF-8 with byte order mark", NULL, 3, false};
    if (any || encoding == ENCODING_UTF_16) {
        if (length >= 2 && bytes[0] == 0xff && bytes[1] == 0xfe)
            return (encoding_choice){"UTF-16LE with byte order mark", "UTF-16LE", 2, true};
        if (length >= 2 && bytes[0] == 0xfe && bytes[1] == 0xff)
            return (encoding_choice){"UTF-16BE with byte order mark", "UTF-16BE", 2, true};
        byte_order order = guess_utf_16(bytes, length);
        if (order == ORDER_BIG)
            return (encoding_choice){"UTF-16BE", "UTF-16BE", 0, true};
        if (order == ORDER_LITTLE || encoding == ENCODING_UTF_16)
            return (encoding_choice){"UTF-16LE", "UTF-16LE", 0, true};
    }
    if (encoding == ENCODING_LATIN_1)
        return (encoding_choice){"Latin-1", "ISO-8859-1", 0, false};
    if (any && utf8_valid_length((const char *)bytes, length) < length)
        return (encoding_choice){"Latin-1", "ISO-8859-1", 0, false};
    return (encoding_choice){"UTF-8", NULL, 0, false};
}

const char *lines_encoding_name(const unsigned char *bytes, size_t length, text_encoding encoding)
{
    return choose_encoding(bytes, length, encoding).words;
}

static const char replacement[] = "\xef\xbf\xbd";

/* Copies a text that should be UTF-8; each invalid byte becomes U+FFFD. */
static char *replace_invalid_utf8(const char *bytes, size_t length, size_t *n_out,
                                  size_t *n_replaced)
{
    const size_t good = utf8_valid_length(bytes, length);
    if (length > (SIZE_MAX - 1) / 3)
        return NULL;
    char *text = malloc((good == length ? length : 3 * length) + 1);
    if (text == NULL)
        return NULL;
    if (length > 0)
        memcpy(text, bytes, good);
    size_t out = good;
    for (size_t i = good; i < length;) {
        size_t n = utf8_character_length(bytes + i, length - i);
        memcpy(text + out, n > 0 ? bytes + i : replacement, n > 0 ? n : 3);
        out += n > 0 ? n : 3;
        *n_replaced += n == 0;
        i += n > 0 ? n : 1;
    }
    *n_out = out;
    return text;
}

/* Records why a converter cannot be opened. Without descriptors the C library finds none and
 * reports an unknown encoding. */
static void note_converter_error(void)
{
    const int probe = open("/dev/null", O_RDONLY | O_CLOEXEC);
    if (probe >= 0)
        (void)close(probe);
    else if (errno == EMFILE || errno == ENFILE)
        resource_error_note(errno);
}

/* Converts a text to UTF-8; NULL without memory or if the system cannot convert. */
static char *convert_to_utf8(const encoding_choice *c, const unsigned char *bytes, size_t length,
                             size_t *n_out, size_t *n_replaced)
{
    const size_t unit = c->utf_16 ? 2 : 1;
    /* two bytes of UTF-16 become at most three bytes, one byte of Latin-1 at most two */
    if (length > (SIZE_MAX - 4) / 3)
        return NULL;
    const size_t capacity = (c->utf_16 ? length / 2 * 3 : 2 * length) + 4;
    char *text = malloc(capacity);
    iconv_t converter = iconv_open("UTF-8", c->iconv);
    if (converter == (iconv_t)-1)
        note_converter_error();
    bool good = text != NULL && converter != (iconv_t)-1;
    char *in = (char *)(uintptr_t)bytes; /* iconv does not write to its input */
    size_t left = length, space = capacity - 1;
    char *out = text;
    while (good && left >= unit) {
        if (iconv(converter, &in, &left, &out, &space) != (size_t)-1)
            break;
        good = errno != E2BIG && space >= 3;
        if (!good)
            break;
        memcpy(out, replacement, 3);
        out += 3;
        space -= 3;
        in += unit;
        left -= unit;
        (*n_replaced)++;
    }
    if (converter != (iconv_t)-1)
        iconv_close(converter);
    if (good) {
        *n_out = (size_t)(out - text);
        return text;
    }
    free(text);
    return NULL;
}

/* True if only the DOS end mark, which is no line, is left. */
static bool is_end_mark(const char *text, size_t length)
{
    return length == 0 || (length == 1 && text[0] == '\x1a');
}

/* Splits the text into lines at CR LF, LF and CR; the line end becomes a zero byte. */
static bool split_lines(text_lines *lines, size_t length)
{
    size_t n = 1, pairs = 0;
    for (size_t i = 0; i < length; i++)
        n += lines->text[i] == '\n' || lines->text[i] == '\r';
    lines->lines = calloc(n, sizeof *lines->lines);
    if (lines->lines == NULL)
        return false;
    size_t start = 0;
    for (size_t i = 0; i < length; i++) {
        const char c = lines->text[i];
        if (c != '\n' && c != '\r')
            continue;
        lines->text[i] = '\0';
        lines->lines[lines->n++] = (text_span){lines->text + start, i - start};
        const bool pair = c == '\r' && i + 1 < length && lines->text[i + 1] == '\n';
        pairs += pair;
        if (c == '\r' && !pair && pairs > 0 && i + 1 == length)
            lines->end = END_HALF;
        i += pair;
        start = i + 1;
    }
    lines->text[length] = '\0';
    if (!is_end_mark(lines->text + start, length - start))
        lines->end = END_NONE;
    if (start < length)
        lines->lines[lines->n++] = (text_span){lines->text + start, length - start};
    return true;
}

static wt_status decode_lines(const encoding_choice *c, const unsigned char *bytes, size_t length,
                              text_lines *lines, wt_error *err)
{
    text_lines made = {.encoding = c->words};
    size_t n = 0;
    bytes = c->mark > 0 ? bytes + c->mark : bytes;
    length -= c->mark;
    made.has_half_character = c->utf_16 && length % 2 == 1;
    length -= made.has_half_character;
    if (c->iconv == NULL)
        made.text = replace_invalid_utf8((const char *)bytes, length, &n, &made.n_replaced);
    else
        made.text = convert_to_utf8(c, bytes, length, &n, &made.n_replaced);
    if (made.text == NULL || !split_lines(&made, n)) {
        lines_free(&made);
        return wt_fail(err, WT_E_MEMORY, "no memory for the text of the file");
    }
    if (made.has_half_character && made.end == END_WHOLE)
        made.end = END_HALF;
    *lines = made;
    return WT_OK;
}

wt_status lines_decode(const unsigned char *bytes, size_t length, text_encoding encoding,
                       text_lines *lines, wt_error *err)
{
    const encoding_choice c = choose_encoding(bytes, length, encoding);
    return decode_lines(&c, bytes, length, lines, err);
}

wt_status lines_decode_next(const unsigned char *bytes, size_t length, text_lines *lines,
                            wt_error *err)
{
    const encoding_choice plain = {.words = "UTF-8"};
    return decode_lines(&plain, bytes, length, lines, err);
}

void lines_free(text_lines *lines)
{
    free(lines->text);
    free(lines->lines);
    *lines = (text_lines){0};
}

bool line_uncomment(const text_description *d, text_span *line)
{
    const size_t n = d->comment != NULL ? strlen(d->comment) : 0;
    if (n == 0 || line->length < n || memcmp(line->text, d->comment, n) != 0)
        return false;
    *line = (text_span){line->text + n, line->length - n};
    return true;
}
