/* Every record of a parameter is valid: names, text, limits and default agree, and a name has one
 * meaning everywhere.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "assert_near.h"
#include "dma/rubber.h"
#include "friction/counter_surface.h"
#include "params/sections.h"

#include <stdalign.h>
#include <string.h>

static const wt_params *(*const tables[])(void) = {
    wt_read_params,
    wt_indent_params,
    wt_master_options_params,
    wt_friction_params,
    wt_layer_params,
    wt_job_params,
    wt_file_set_params,
    wt_convert_job_params,
    wt_indent_job_params,
    wt_master_job_params,
    wt_compare_job_params,
    wt_sliding_params,
    wt_layer_observation_params,
    wt_layer_job_params,
    wt_run_params,
    wt_report_params,
    flow_self_affine_params,
    flow_spectrum_params,
    case_group_params,
    case_prony_params,
    case_term_params,
    case_wlf_params,
    flow_zener_params,
    wt_transverse_params,
    wt_accuracy_job_params,
    wt_ramp_job_params,
    wt_reduction_params,
};
enum { N_TABLES = sizeof tables / sizeof tables[0] };

static void test_words(void **state)
{
    (void)state;
    for (size_t t = 0; t < N_TABLES; t++) {
        const wt_params *params = tables[t]();
        const size_t n = wt_params_count(params);
        assert_in_range(n, 1, PARAM_COUNT_MAX);
        for (size_t i = 0; i < n; i++) {
            const wt_param *p = wt_params_get(params, i);
            const bool is_option = (p->flags & PARAM_NO_OPTION) == 0;
            if (strspn(p->name, "abcdefghijklmnopqrstuvwxyz0123456789-") != strlen(p->name))
                fail_msg("--%s is no name of an option", p->name);
            if (p->help == NULL || p->help[0] == '\0' || p->help[strlen(p->help) - 1] == '.')
                fail_msg("%s: help is text without a stop at its end", p->name);
            if ((p->kind == PARAM_CHOICE || is_option) && p->kind != PARAM_FLAG && p->value == NULL)
                fail_msg("%s: nothing stands for its value in the help", p->name);
            if (p->kind == PARAM_CHOICE && strchr(p->value, '|') == NULL)
                fail_msg("%s: a choice of one", p->name);
            if (strncmp(p->name, "no-", 3) == 0)
                fail_msg("%s: a flag that is set by default gets its no- from the default",
                         p->name);
            for (size_t k = 0; k < i; k++)
                if (strcmp(wt_params_get(params, k)->name, p->name) == 0)
                    fail_msg("%s stands twice in a table", p->name);
        }
    }
}

/* The text of a default is valid input, so it lies within the limits. */
static void test_defaults(void **state)
{
    (void)state;
    for (size_t t = 0; t < N_TABLES; t++) {
        const wt_params *params = tables[t]();
        for (size_t i = 0; i < wt_params_count(params); i++) {
            alignas(max_align_t) unsigned char structure[PARAM_STRUCTURE_SIZE_MAX] = {0};
            const wt_param *p = wt_params_get(params, i);
            char set[256];
            uint64_t given = 0;
            wt_error err = WT_ERROR_INIT;
            wt_params_default(params, i, set, sizeof set);
            if ((p->flags & PARAM_REQUIRED) != 0) {
                assert_string_equal(set, "");
                continue;
            }
            if ((p->unset != NULL && strcmp(p->unset, set) == 0) ||
                (p->flags & PARAM_ONLY_C) == PARAM_ONLY_C)
                continue;
            params->defaults(structure);
            if (wt_params_set(params, p->name, structure, set, &given, &err) != WT_OK)
                fail_msg("%s: the default \"%s\": %s", p->name, set, err.message);
            assert_true(given == UINT64_C(1) << i);
        }
    }
}

/* Limits are an interval; those that only C accepts may be wider. */
static void test_one_name_one_meaning(void **state)
{
    (void)state;
    const wt_param *all[N_TABLES * PARAM_COUNT_MAX];
    size_t n = 0;
    for (size_t t = 0; t < N_TABLES; t++)
        for (size_t i = 0; i < wt_params_count(tables[t]()); i++) {
            const wt_param *p = wt_params_get(tables[t](), i);
            const bool is_number = p->kind == PARAM_NUMBER || p->kind == PARAM_ESTIMATE ||
                                   p->kind == PARAM_LIST || p->kind == PARAM_COUNT;
            if (is_number && !(p->limits.low < p->limits.high))
                fail_msg("%s: nothing lies within its limits", p->name);
            if ((p->flags & PARAM_ONLY_C) != PARAM_ONLY_C)
                all[n++] = p;
        }
    for (size_t i = 0; i < n; i++)
        for (size_t k = 0; k < i; k++) {
            const param_limits *a = &all[i]->limits, *b = &all[k]->limits;
            if (strcmp(all[i]->name, all[k]->name) != 0)
                continue;
            if (all[i]->quantity != all[k]->quantity || a->low < b->low || a->low > b->low ||
                a->high < b->high || a->high > b->high || a->with_low != b->with_low ||
                a->with_high != b->with_high)
                fail_msg("%s means two things", all[i]->name);
        }
}

typedef struct sample {
    double number;
    const double *list;
    size_t n_list;
    const char *const *texts;
    size_t n_texts;
    uint64_t wide;
    unsigned narrow;
} sample;

static sample no_sample(void)
{
    return (sample){.number = (double)NAN};
}

static const wt_param sample_rows[] = {
    {PARAM("number", sample, number, WT_Q_LENGTH, FROM_BELOW(0, 1)), .unset = "",
     .help = "a number"},
    {PARAM_LIST_OF("list", sample, list, n_list, WT_Q_NONE, AT_LEAST(1)), .unset = "",
     .help = "a list"},
    {PARAM_TEXTS_OF("texts", sample, texts, n_texts), .value = "NAME=UNIT", .unset = "",
     .help = "texts"},
    {PARAM("wide", sample, wide, WT_Q_NONE, AT_LEAST(0)), .help = "64 bits"},
    {PARAM("narrow", sample, narrow, WT_Q_NONE, AT_LEAST(0)), .help = "32 bits"},
};
PARAM_LOCAL_TABLE(sample_params, sample, sample_rows, no_sample, NO_PARTS)

static wt_status set(sample *s, const char *name, const char *text, uint64_t *given, wt_error *err)
{
    *err = (wt_error)WT_ERROR_INIT;
    return wt_params_set(sample_params(), name, s, text, given, err);
}

static void test_setting(void **state)
{
    (void)state;
    sample s = no_sample();
    uint64_t given = 0;
    wt_error err;
    static const char *const borrowed[] = {"E'=Pa"};
    assert_int_equal(set(&s, "none", "1", &given, &err), WT_E_NOT_FOUND);
    assert_int_equal(set(&s, "number", "999mm", &given, &err), WT_OK);
    assert_near(s.number, 0.999, 1e-15);
    assert_int_equal(set(&s, "number", "1m", &given, &err), WT_E_RANGE);
    assert_string_equal(err.expected, "0 to below 1 m");
    assert_string_equal(err.found, "1m");
    assert_near(s.number, 0.999, 1e-15);
    assert_int_equal(set(&s, "number", "0.5m +- 10%", &given, &err), WT_E_ARG);
    assert_int_equal(set(&s, "number", "0.5m +- 0m", &given, &err), WT_OK);
    assert_int_equal(set(&s, "list", "1:10:log:3", &given, &err), WT_OK);
    assert_int_equal(set(&s, "list", "1,2,3,4", &given, &err), WT_OK); /* replaces the first one */
    assert_int_equal(s.n_list, 4);
    assert_int_equal(set(&s, "list", "0.5,2", &given, &err), WT_E_RANGE);
    s.texts = borrowed; /* a default that the table must not extend */
    s.n_texts = 1;
    assert_int_equal(set(&s, "texts", "E'=MPa; E''=kPa", &given, &err), WT_OK);
    assert_int_equal(set(&s, "texts", "T=K", &given, &err), WT_OK);
    assert_int_equal(s.n_texts, 3);
    assert_string_equal(s.texts[1], "E''=kPa");
    assert_int_equal(set(&s, "texts", "T=", &given, &err), WT_E_ARG);
    assert_int_equal(set(&s, "texts", "=K", &given, &err), WT_E_ARG);
    assert_int_equal(set(&s, "wide", "18446744073709551615", &given, &err), WT_OK);
    assert_true(s.wide == UINT64_MAX);
    assert_int_equal(set(&s, "wide", "18446744073709551616", &given, &err), WT_E_ARG);
    assert_int_equal(set(&s, "narrow", "4294967296", &given, &err), WT_E_ARG);
    assert_int_equal(set(&s, "narrow", "4294967295", &given, &err), WT_OK);
    assert_true(s.narrow == UINT32_MAX);
    assert_true(given == 31);
    assert_int_equal(param_check(sample_params(), &s, &err), WT_OK);
    wt_params_clear(sample_params(), &s, &given);
    assert_true(given == 0 && s.n_list == 0 && s.list == NULL && s.n_texts == 0);
    s.number = 1;
    assert_int_equal(param_check(sample_params(), &s, &err), WT_E_RANGE);
    assert_string_equal(err.place, "number");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_words),
        cmocka_unit_test(test_defaults),
        cmocka_unit_test(test_one_name_one_meaning),
        cmocka_unit_test(test_setting),
    };
    return cmocka_run_group_tests_name("records of parameters", tests, NULL, NULL);
}
