/* Reads the encoding and calibration of a JPK channel. SPDX-License-Identifier: GPL-3.0-or-later */
#include "read/jpk/jpk.h"

#include <math.h>
#include <string.h>

/* Finds a property that files of version 0 store below "data.". */
static const char *find_versioned_property(const property_list *properties, const char *prefix,
                                           const char *key)
{
    char longer[128];
    snprintf(longer, sizeof longer, "data.%s", key);
    const char *text = properties_find(properties, prefix, longer);
    return text != NULL ? text : properties_find(properties, prefix, key);
}

static wt_status fail_unsupported(wt_error *err, const char *what, const char *found)
{
    wt_fail(err, WT_E_UNSUPPORTED, "%s is not supported", what);
    wt_error_found(err, "%s", found != NULL ? found : "nothing");
    return WT_E_UNSUPPORTED;
}

typedef struct encoding_name {
    const char *name;
    sample_type type;
} encoding_name;

static bool find_encoding(const encoding_name names[], size_t n, const char *name,
                          sample_type *encoding)
{
    for (size_t i = 0; i < n; i++) {
        if (strcmp(names[i].name, name) != 0)
            continue;
        *encoding = names[i].type;
        return true;
    }
    return false;
}

static wt_status read_encoding(const property_list *properties, const char *prefix, jpk_lcd *lcd,
                               wt_error *err)
{
    static const encoding_name types[] = {
        {"float-data", SAMPLE_FLOAT32}, {"memory-float-data", SAMPLE_FLOAT32},
        {"float", SAMPLE_FLOAT32},      {"double-data", SAMPLE_FLOAT64},
        {"double", SAMPLE_FLOAT64},     {"memory-double-data", SAMPLE_FLOAT64}};
    static const encoding_name encoders[] = {
        {"signedshort", SAMPLE_INT16},      {"signedshort-limited", SAMPLE_INT16},
        {"unsignedshort", SAMPLE_UINT16},   {"unsignedshort-limited", SAMPLE_UINT16},
        {"signedinteger", SAMPLE_INT32},    {"signedinteger-limited", SAMPLE_INT32},
        {"unsignedinteger", SAMPLE_UINT32}, {"unsignedinteger-limited", SAMPLE_UINT32}};
    const char *type = find_versioned_property(properties, prefix, "type");
    const char *encoder = find_versioned_property(properties, prefix, "encoder.type");
    if (type == NULL)
        return fail_unsupported(err, "channel without a data type", type);
    lcd->raster = strcmp(type, "raster-data") == 0;
    if (lcd->raster || find_encoding(types, sizeof types / sizeof *types, type, &lcd->encoding))
        return WT_OK;
    if (encoder == NULL)
        return fail_unsupported(err, "channel data type without encoder", type);
    if (!find_encoding(encoders, sizeof encoders / sizeof *encoders, encoder, &lcd->encoding))
        return fail_unsupported(err, "channel encoder", encoder);
    return WT_OK;
}

static bool copy_bounded(char *to, size_t size, const char *from)
{
    size_t n = from == NULL ? 0 : strlen(from);
    if (n >= size)
        return false;
    memcpy(to, from == NULL ? "" : from, n);
    to[n] = '\0';
    return true;
}

/* Reads the keys "….scaling.": y = multiplier x + offset. */
static wt_status read_scaling(const property_list *properties, const char *prefix,
                              force_linear *scaling, wt_error *err)
{
    const char *style = properties_find(properties, prefix, "scaling.style");
    if (style != NULL && strcmp(style, "offsetmultiplier") != 0)
        return fail_unsupported(err, "scaling style", style);
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
    static const char *const prefixes[] = {"encoder.", "data.encoder."};
    char key[192];
    lcd->encoder = (force_linear){1, 0};
    const char *unit = properties_find(properties, prefix, "unit.unit");
    for (size_t i = 0; i < 2; i++) {
        snprintf(key, sizeof key, "%s%s", prefix, prefixes[i]);
        if (properties_find(properties, key, "scaling.multiplier") == NULL)
            continue;
        wt_status status = read_scaling(properties, key, &lcd->encoder, err);
        if (status != WT_OK)
            return status;
        const char *own = properties_find(properties, key, "scaling.unit.unit");
        unit = own != NULL ? own : unit;
        break;
    }
    if (!copy_bounded(lcd->base_unit, sizeof lcd->base_unit, unit))
        return fail_unsupported(err, "unit of a channel", unit);
    return WT_OK;
}

/* Reads a calibration slot. A slot that the file does not define is skipped. */
static wt_status read_slot(const property_list *properties, const char *prefix, const char *name,
                           jpk_lcd *lcd, wt_error *err)
{
    char key[192 + JPK_NAME];
    snprintf(key, sizeof key, "%sconversion-set.conversion.%s.", prefix, name);
    const char *defined = properties_find(properties, key, "defined");
    if (defined == NULL || strcmp(defined, "true") != 0)
        return WT_OK;
    if (lcd->n_slots == JPK_SLOTS)
        return fail_unsupported(err, "channel with so many calibration slots", name);
    jpk_slot *slot = &lcd->slots[lcd->n_slots];
    const char *base = properties_find(properties, key, "base-calibration-slot");
    const char *unit = properties_find(properties, key, "scaling.unit.unit");
    if (!copy_bounded(slot->name, sizeof slot->name, name) ||
        !copy_bounded(slot->base, sizeof slot->base, base) ||
        !copy_bounded(slot->unit, sizeof slot->unit, unit))
        return fail_unsupported(err, "calibration slot", name);
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
    if (!copy_bounded(lcd->base, sizeof lcd->base, base) ||
        !copy_bounded(lcd->preferred, sizeof lcd->preferred, preferred != NULL ? preferred : base))
        return fail_unsupported(err, "calibration slot", base);
    const char *list = properties_find(properties, prefix, "conversion-set.conversions.list");
    char name[JPK_NAME];
    while (status == WT_OK && property_next_token(&list, name, sizeof name))
        status = read_slot(properties, prefix, name, lcd, err);
    return status;
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
    /* From the requested slot down to the base. More steps than slots mean a cycle. */
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
