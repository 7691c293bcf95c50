/* Parser of a law given as an option value, such as "self-affine:q0=1e3rad/m,...".
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "dma/law_parse.h"

#include "core/base/param.h"
#include "core/base/spell_suggest.h"

#include <stdlib.h>
#include <string.h>

bool flow_has_law_prefix(const flow_law_text *law, const char *text)
{
    return strncmp(text, law->prefix, strlen(law->prefix)) == 0;
}

static wt_status expect_spelling(const flow_law_text *law, wt_error *err)
{
    wt_error_expected(err, "%s%s", law->prefix, law->example);
    return WT_E_ARG;
}

wt_status flow_law_suggest(const flow_law_text *law, const char *text, wt_status status,
                           wt_error *err)
{
    const size_t length = strcspn(text, ":");
    spell_suggestion near = spell_suggestion_begin(text, length);
    spell_suggestion_try(&near, law->prefix, strlen(law->prefix) - 1);
    if (status != WT_E_NOT_FOUND || text[length] != ':' || near.name == NULL)
        return status;
    status = wt_fail(err, WT_E_ARG, "\"%s\" is no file, and no %s", text, law->name);
    wt_error_advice(err, "did you mean %s%s?", law->prefix, law->example);
    return status;
}

static void suggest_parameter(const wt_params *params, const char *name, wt_error *err)
{
    spell_suggestion near = spell_suggestion_begin(name, strlen(name));
    for (size_t i = 0; i < wt_params_count(params); i++) {
        const char *const known = wt_params_get(params, i)->name;
        spell_suggestion_try(&near, known, strlen(known));
    }
    if (near.name != NULL)
        wt_error_advice(err, "did you mean %s?", near.name);
}

wt_status flow_law_parse(const flow_law_text *law, const char *text, void *structure, wt_error *err)
{
    text += strlen(law->prefix);
    char *copy = wt_strdup(text), *rest = NULL;
    uint64_t given = 0;
    wt_status status = WT_OK;
    for (char *item = strtok_r(copy, ",", &rest); status == WT_OK && item != NULL;
         item = strtok_r(NULL, ",", &rest)) {
        char *value = strchr(item, '=');
        if (value == NULL) {
            wt_fail(err, WT_E_ARG, "\"%s\" is not NAME=VALUE", item);
            status = expect_spelling(law, err);
            break;
        }
        *value++ = '\0';
        status = wt_params_set(law->params(), item, structure, value, &given, err);
        if (status == WT_E_NOT_FOUND) {
            wt_fail(err, WT_E_ARG, "%s has no parameter \"%s\"", law->what, item);
            suggest_parameter(law->params(), item, err);
            status = expect_spelling(law, err);
        } else if (status != WT_OK) {
            wt_error_place(err, "%s, %s", law->what, item);
        }
    }
    if (status == WT_OK && param_find_missing(law->params(), given) != NULL) {
        wt_fail(err, WT_E_MISSING, "the %s is not complete", law->name);
        wt_error_found(err, "\"%s\"", text);
        (void)expect_spelling(law, err);
        status = WT_E_MISSING;
    }
    free(copy);
    return status;
}
