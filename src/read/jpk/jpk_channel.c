/* JPK channels: how the numbers of a data file become physical values.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "read/bytes/bytes.h"
#include "read/jpk/jpk.h"

#include <math.h>
#include <string.h>

size_t jpk_encoding_width(jpk_encoding encoding)
{
    switch (encoding) {
    case JPK_INT16:
    case JPK_UINT16:
        return 2;
    case JPK_INT32:
    case JPK_UINT32:
    case JPK_FLOAT32:
        return 4;
    case JPK_FLOAT64:
        return 8;
    case JPK_RASTER:
        break;
    }
    return 0;
}

static bool one_of(const char *text, const char *const names[], size_t n)
{
    for (size_t i = 0; i < n; i++)
        if (strcmp(text, names[i]) == 0)
            return true;
    return false;
}

#define ONE_OF(text, ...)                                                                          \
    one_of((text), (const char *const[]){__VA_ARGS__},                                             \
           sizeof((const char *const[]){__VA_ARGS__}) / sizeof(char *))

/* Files of version 0 keep type and encoder below "data.". */
static const char *either(const property_list *properties, const char *prefix, const char *key)
{
    char longer[128];
    snprintf(longer, sizeof longer, "data.%s", key);
    const char *text = properties_find(properties, prefix, longer);
    return text != NULL ? text : properties_find(properties, prefix, key);
}

static wt_status unsupported(wt_error *err, const char *what, const char *found)
{
    wt_fail(err, WT_E_UNSUPPORTED, "%s is not supported", what);
    wt_error_found(err, "%s", found != NULL ? found : "nothing");
    return WT_E_UNSUPPORTED;
}

static wt_status read_encoding(const property_list *properties, const char *prefix, jpk_lcd *lcd,
                               wt_error *err)
{
    const char *type = either(properties, prefix, "type");
    const char *encoder = either(properties, prefix, "encoder.type");
    if (type == NULL)
        return unsupported(err, "channel without a data type", type);
    if (ONE_OF(type, "float-data", "memory-float-data", "float"))
        lcd->encoding = JPK_FLOAT32;
    else if (ONE_OF(type, "double-data", "memory-double-data", "double"))
        lcd->encoding = JPK_FLOAT64;
    else if (strcmp(type, "raster-data") == 0)
        lcd->encoding = JPK_RASTER;
    else if (encoder == NULL)
        return unsupported(err, "channel data type without encoder", type);
    else if (ONE_OF(encoder, "signedshort", "signedshort-limited"))
        lcd->encoding = JPK_INT16;
    else if (ONE_OF(encoder, "unsignedshort", "unsignedshort-limited"))
        lcd->encoding = JPK_UINT16;
    else if (ONE_OF(encoder, "signedinteger", "signedinteger-limited"))
        lcd->encoding = JPK_INT32;
    else if (ONE_OF(encoder, "unsignedinteger", "unsignedinteger-limited"))
        lcd->encoding = JPK_UINT32;
    else
        return unsupported(err, "channel encoder", encoder);
    return WT_OK;
}

static bool copy_name(char *to, size_t size, const char *from)
{
    size_t n = from == NULL ? 0 : strlen(from);
    if (n >= size)
        return false;
    memcpy(to, from == NULL ? "" : from, n);
    to[n] = '\0';
    return true;
}

/* "….scaling." keys: y = multiplier x + offset. */
static wt_status read_scaling(const property_list *properties, const char *prefix,
                              force_linear *scaling, wt_error *err)
{
    const char *style = properties_find(properties, prefix, "scaling.style");
    if (style != NULL && strcmp(style, "offsetmultiplier") != 0)
        return unsupported(err, "scaling style", style);
    scaling->multiplier = properties_number(properties, prefix, "scaling.multiplier");
    scaling->offset = properties_number(properties, prefix, "scaling.offset");
    if (isnan(scaling->multiplier) || isnan(scaling->offset)) {
        wt_fail(err, WT_E_CORRUPT, "scaling without multiplier or offset");
        wt_error_found(err, "%sscaling", prefix);
        return WT_E_CORRUPT;
    }
    return WT_OK;
}

static wt_status read_encoder(const property_list *properties, const char *prefix, jpk_lcd *lcd,
                              wt_error *err)
{
    static const char *const places[] = {"encoder.", "data.encoder."};
    char key[192];
    lcd->encoder = (force_linear){1, 0};
    const char *unit = properties_find(properties, prefix, "unit.unit");
    for (size_t i = 0; i < 2; i++) {
        snprintf(key, sizeof key, "%s%s", prefix, places[i]);
        if (properties_find(properties, key, "scaling.multiplier") == NULL)
            continue;
        wt_status status = read_scaling(properties, key, &lcd->encoder, err);
        if (status != WT_OK)
            return status;
        const char *own = properties_find(properties, key, "scaling.unit.unit");
        unit = own != NULL ? own : unit;
        break;
    }
    if (!copy_name(lcd->base_unit, sizeof lcd->base_unit, unit))
        return unsupported(err, "unit of a channel", unit);
    return WT_OK;
}

/* One calibration slot; those that the file does not define are left out. */
static wt_status read_slot(const property_list *properties, const char *prefix, const char *name,
                           jpk_lcd *lcd, wt_error *err)
{
    char key[192 + JPK_NAME];
    snprintf(key, sizeof key, "%sconversion-set.conversion.%s.", prefix, name);
    const char *defined = properties_find(properties, key, "defined");
    if (defined == NULL || strcmp(defined, "true") != 0)
        return WT_OK;
    if (lcd->n_slots == JPK_SLOTS)
        return unsupported(err, "channel with so many calibration slots", name);
    jpk_slot *slot = &lcd->slots[lcd->n_slots];
    const char *base = properties_find(properties, key, "base-calibration-slot");
    const char *unit = properties_find(properties, key, "scaling.unit.unit");
    if (!copy_name(slot->name, sizeof slot->name, name) ||
        !copy_name(slot->base, sizeof slot->base, base) ||
        !copy_name(slot->unit, sizeof slot->unit, unit))
        return unsupported(err, "calibration slot", name);
    wt_status status = read_scaling(properties, key, &slot->scaling, err);
    if (status == WT_OK)
        lcd->n_slots++;
    return status;
}

wt_status jpk_lcd_read(const property_list *properties, const char *prefix, jpk_lcd *lcd,
                       wt_error *err)
{
    *lcd = (jpk_lcd){0};
    wt_status status = read_encoding(properties, prefix, lcd, err);
    if (status == WT_OK)
        status = read_encoder(properties, prefix, lcd, err);
    if (status != WT_OK)
        return status;
    const char *base = properties_find(properties, prefix, "conversion-set.conversions.base");
    const char *preferred =
        properties_find(properties, prefix, "conversion-set.conversions.default");
    if (!copy_name(lcd->base, sizeof lcd->base, base) ||
        !copy_name(lcd->preferred, sizeof lcd->preferred, preferred != NULL ? preferred : base))
        return unsupported(err, "calibration slot", base);
    const char *list = properties_find(properties, prefix, "conversion-set.conversions.list");
    while (list != NULL && *list != '\0') {
        char name[JPK_NAME];
        size_t n = strcspn(list, " ");
        if (n > 0 && n < sizeof name) {
            memcpy(name, list, n);
            name[n] = '\0';
            status = read_slot(properties, prefix, name, lcd, err);
            if (status != WT_OK)
                return status;
        }
        list += n + strspn(list + n, " ");
    }
    return WT_OK;
}

const jpk_slot *jpk_lcd_slot(const jpk_lcd *lcd, const char *name)
{
    for (size_t i = 0; i < lcd->n_slots; i++)
        if (strcmp(lcd->slots[i].name, name) == 0)
            return &lcd->slots[i];
    return NULL;
}

bool jpk_lcd_chain(const jpk_lcd *lcd, const char *slot, force_linear *chain)
{
    force_linear total = {1, 0};
    /* From the wanted slot down to the base; more steps than slots is a circle. */
    for (size_t step = 0; step <= lcd->n_slots; step++) {
        if (strcmp(slot, lcd->base) == 0) {
            *chain = total;
            return true;
        }
        const jpk_slot *s = jpk_lcd_slot(lcd, slot);
        if (s == NULL)
            return false;
        total.offset += total.multiplier * s->scaling.offset;
        total.multiplier *= s->scaling.multiplier;
        slot = s->base;
    }
    return false;
}

/* One loop per encoding: the choice is made once, not per sample. */
#define DECODE(width, number)                                                                      \
    for (size_t i = 0; i < n; i++) {                                                               \
        const unsigned char *b = raw + (width)*i;                                                  \
        values[i] = m * (double)(number) + o;                                                      \
    }                                                                                              \
    break

size_t jpk_decode(jpk_encoding encoding, force_linear scaling, const unsigned char *raw, size_t n,
                  double *values)
{
    const double m = scaling.multiplier, o = scaling.offset;
    switch (encoding) {
    case JPK_INT16:
        DECODE(2, signed16(be16(b)));
    case JPK_UINT16:
        DECODE(2, be16(b));
    case JPK_INT32:
        DECODE(4, signed32(be32(b)));
    case JPK_UINT32:
        DECODE(4, be32(b));
    case JPK_FLOAT32:
        DECODE(4, float32(be32(b)));
    case JPK_FLOAT64:
        DECODE(8, float64(be64(b)));
    case JPK_RASTER:
        for (size_t i = 0; i < n; i++)
            values[i] = m * (double)i + o;
        break;
    }
    size_t missing = 0;
    for (size_t i = 0; i < n; i++) {
        if (isfinite(values[i]))
            continue;
        values[i] = (double)NAN;
        missing++;
    }
    return missing;
}
