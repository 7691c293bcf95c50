/* The plan: stages that run, stages that do not, and the reasons. No data file of these cases
 * exists.
 * SPDX-License-Identifier: GPL-3.0-or-later */

#include "case/plan/stages.h"
#include "table_cells.h"
#include "weartrack/case.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#define HEAD "<case version=\"1\">\n"
#define BULK "<bulk><files>bulk/*</files></bulk>"
#define TRACK "<track><files>track/*</files></track>"
#define TIP "<tip>sphere:radius=5um</tip>"
#define DMA "<dma><files>dma/*</files></dma>"
#define PRONY                                                                                      \
    "<dma><prony deformation=\"tension\"><equilibrium>1MPa</equilibrium>"                          \
    "<term time=\"1ms\" modulus=\"5MPa\"/></prony></dma>"
#define ROAD                                                                                       \
    "<roughness><self-affine><q0>1e3rad/m</q0><q1>1e6rad/m</q1><hurst>0.8</hurst>"                 \
    "<c0>1e-17m^4</c0></self-affine></roughness>"
#define SLIDE "<sliding><pressure>0.4MPa</pressure><velocity>1m/s</velocity></sliding>"
#define LAYER                                                                                      \
    "<layer><specific-wear-rate>1e-3mm^3/(N m)</specific-wear-rate>"                               \
    "<critical-energy>1e10J/m^3</critical-energy></layer>"

static wt_table *plan_of(const char *text)
{
    char path[] = "/tmp/weartrack-plan-XXXXXX";
    int file = mkstemp(path);
    wt_case *c = NULL;
    wt_table *plan = NULL;
    wt_error err = WT_ERROR_INIT;
    assert_true(file >= 0);
    assert_int_equal(write(file, text, strlen(text)), (ssize_t)strlen(text));
    close(file);
    if (wt_case_read(path, &c, &err) != WT_OK)
        fail_msg("%s: %s %s", err.place, err.message, err.found);
    assert_int_equal(wt_plan(c, &plan, NULL), WT_OK);
    unlink(path);
    wt_case_free(c);
    return plan;
}

/* `runs` lists the running stages, each followed by a blank. */
static void check_plan(const char *text, const char *runs)
{
    wt_table *plan = plan_of(text);
    char found[512] = "";
    assert_int_equal(wt_table_n_rows(plan), FLOW_N_STAGES);
    for (size_t i = 0; i < wt_table_n_rows(plan); i++) {
        bool chosen = number_cell(plan, i, "runs") > 0;
        const char *because = text_cell(plan, i, "reason");
        assert_int_equal(
            strncmp(because, chosen ? "runs because " : "left out because ", chosen ? 13 : 17), 0);
        if (chosen) {
            strcat(found, text_cell(plan, i, "stage"));
            strcat(found, " ");
        }
    }
    assert_string_equal(found, runs);
    wt_table_free(plan);
}

static void check_because(const char *text, const char *stage, const char *part)
{
    wt_table *plan = plan_of(text);
    const char *because = text_cell(plan, row_where(plan, "stage", stage), "reason");
    if (strstr(because, part) == NULL)
        fail_msg("%s: %s", stage, because);
    wt_table_free(plan);
}

static void test_stages_that_run(void **state)
{
    (void)state;
    check_plan(HEAD "</case>", "");
    check_plan(HEAD "<indentation>" TIP BULK "</indentation></case>", "indentation_bulk groups ");
    check_plan(HEAD "<indentation>" TIP BULK TRACK "</indentation></case>",
               "indentation_bulk indentation_track comparison track_layer ");
    check_plan(HEAD "<indentation>" TIP BULK TRACK "</indentation><compare/></case>",
               "indentation_bulk indentation_track groups ");
    check_plan(HEAD DMA "</case>", "master_curve ");
    check_plan(HEAD PRONY ROAD SLIDE "</case>",
               "given_material roughness friction contact_area what_if ");
    check_plan(HEAD PRONY ROAD SLIDE LAYER "</case>",
               "given_material roughness layer energy_density friction contact_area what_if ");
    check_plan(HEAD "<indentation>" TIP BULK "</indentation>" DMA "</case>",
               "master_curve indentation_bulk groups dma_comparison ");
    check_plan(HEAD "<indentation>" TIP BULK TRACK "</indentation>" DMA ROAD SLIDE LAYER "</case>",
               "master_curve indentation_bulk indentation_track "
               "comparison "
               "dma_comparison roughness layer track_layer energy_density friction "
               "contact_area what_if ");
}

/* The name of a stage states the effects that it includes. */
static void check_title(const char *text, const char *stage, const char *title)
{
    wt_table *plan = plan_of(text);
    assert_string_equal(text_cell(plan, row_where(plan, "stage", stage), "title"), title);
    wt_table_free(plan);
}

static void test_titles(void **state)
{
    (void)state;
    check_title(HEAD PRONY ROAD SLIDE "</case>", "friction", "Contact area and friction");
    check_title(HEAD "<indentation>" TIP BULK TRACK "</indentation>" DMA ROAD SLIDE LAYER "</case>",
                "friction", "Contact area and friction, with and without the layer");
    check_title(HEAD PRONY ROAD SLIDE LAYER "</case>", "what_if",
                "What if a choice of the model were another: friction, thickness of the layer");
    check_title(HEAD "<indentation>" TIP BULK "</indentation>" DMA "</case>", "dma_comparison",
                "Indentation against DMA, bulk");
}

/* Only requested stages run, and only their inputs are read. */
static void test_requested_stages(void **state)
{
    (void)state;
#define ALL HEAD "<indentation>" TIP BULK TRACK "</indentation>" DMA ROAD SLIDE LAYER
    check_plan(ALL "<report><result>prony</result></report></case>", "master_curve ");
    check_plan(ALL "<report><result>layer</result></report></case>",
               "master_curve roughness layer ");
    check_plan(ALL "<report><result>roughness</result></report></case>", "roughness ");
    check_plan(ALL "<report><result>indentation/track</result></report></case>",
               "master_curve indentation_track ");
    check_plan(ALL "<report><result>energy_density</result></report></case>",
               "master_curve roughness energy_density ");
    check_plan(ALL "<report><result>contact_area</result></report></case>",
               "master_curve roughness contact_area ");
    check_plan(ALL "<report><result>modulus_groups</result></report></case>",
               "master_curve indentation_bulk indentation_track "
               "groups ");
    check_plan(ALL "<report><result>cost</result></report></case>", "");
    check_plan(ALL "<report><figure>power_spectrum</figure></report></case>", "roughness ");
    check_plan(ALL "<compare><track-to-bulk/></compare></case>",
               "master_curve indentation_bulk indentation_track "
               "comparison "
               "roughness layer track_layer energy_density friction contact_area "
               "what_if ");
    check_plan(ALL "<report><result>friction</result></report></case>",
               "master_curve indentation_bulk indentation_track "
               "comparison "
               "roughness layer friction ");
    check_plan(ALL "<report><result>what_if</result></report></case>",
               "master_curve indentation_bulk indentation_track "
               "comparison "
               "roughness what_if ");
    /* includes the errors of friction and layer */
    check_plan(ALL "<report><figure>what_if</figure></report></case>",
               "master_curve indentation_bulk indentation_track "
               "comparison "
               "roughness layer friction what_if ");
}

/* A record is compared with the case for any list of tables, unless this is switched off. */
static void test_records(void **state)
{
    (void)state;
#define HELD                                                                                       \
    HEAD PRONY ROAD SLIDE                                                                          \
        "<layer><specific-wear-rate>1e-3mm^3/(N m)</specific-wear-rate><critical-energy>"          \
        "1e10J/m^3</critical-energy><modulus-ratio>0.6</modulus-ratio></layer><record>"            \
        "<files>disc.csv</files>"
#define FIGURE "</record><report><figure>friction</figure></report></case>"
    static const char held[] = "given_material record roughness given_ratio layer friction "
                               "validation validation_running_in ";
    static const char off[] = "given_material roughness given_ratio layer friction ";
    check_plan(HELD FIGURE, held);
    check_because(HELD FIGURE, "validation", "the case has a record");
    check_because(HELD FIGURE, "validation_running_in", "the case has a record");
    check_plan(HELD "<validate>no</validate>" FIGURE, off);
    check_because(HELD "<validate>no</validate>" FIGURE, "validation", "switches it off");
    check_because(HELD "<validate>no</validate></record></case>", "validation", "switches it off");
    /* if it is requested, that is the reason */
    check_because(HELD "</record></case>", "validation", "validation is asked for");
}

static void test_reasons(void **state)
{
    (void)state;
    check_because(HEAD PRONY ROAD SLIDE "</case>", "layer", "no layer parameters (<layer>)");
    check_because(HEAD PRONY ROAD "</case>", "friction", "no sliding conditions (<sliding>)");
    check_because(HEAD ROAD SLIDE "</case>", "friction", "no DMA files");
    check_because(HEAD "<indentation>" TIP BULK "</indentation></case>", "comparison",
                  "no wear-track curves");
    check_because(
        HEAD PRONY ROAD SLIDE LAYER "</case>", "friction",
        "friction is asked for; without the layer, for the case has no bulk curves (<bulk> "
        "in <indentation>) and no modulus ratio");
    check_because(HEAD PRONY ROAD SLIDE "</case>", "what_if",
                  "without the layer, for the case has no layer parameters (<layer>)");
    check_because(HEAD PRONY ROAD SLIDE LAYER "</case>", "what_if",
                  "without the modulus ratio of the layer, for the case has no bulk curves");
    check_because(HEAD "<indentation>" TIP BULK "</indentation></case>", "indentation_bulk",
                  "without the spectrum of the material, for the case has no DMA files (<files> in "
                  "<dma>) and no material");
    check_because(HEAD PRONY "</case>", "groups",
                  "left out because the case has no bulk curves (<bulk> in <indentation>) and no "
                  "wear-track curves (<track> in <indentation>)");
    check_because(ALL "</case>", "groups", "comparison gives its results and more");
    check_because(ALL "</case>", "master_curve", "indentation_bulk needs its material");
    check_because(ALL "<report><result>layer</result></report></case>", "master_curve",
                  "layer needs its material");
    check_because(ALL "<report><result>layer</result></report></case>", "indentation_bulk",
                  "no requested table needs it");
    check_because(ALL "<report><result>shift_factors</result></report></case>", "master_curve",
                  "runs because shift_factors is asked for; nothing needs master_curve, "
                  "relaxation_spectrum, which it leaves out");
    check_because(ALL "<report><result>master_curve</result></report></case>", "master_curve",
                  "nothing needs relaxation_spectrum, which it leaves out");
}

/* Every stage comes after those it needs, each level needs more than the previous one, and every
 * table has a stage. */
static void test_table_of_stages(void **state)
{
    (void)state;
    flow_resource_set given = FLOW_SOURCES;
    for (size_t i = 0; i < FLOW_N_STAGES; i++) {
        const unsigned levels = flow_stage_levels(i);
        assert_int_equal(flow_stage_needs(i, levels) & ~given, 0);
        assert_int_equal(flow_stages[i].alternatives & ~given, 0);
        assert_true((flow_stage_needs(i, 0) | flow_stages[i].alternatives) != 0);
        for (unsigned k = 0; k < levels; k++)
            assert_true((flow_stages[i].optional_inputs[k].resources & ~flow_stage_needs(i, k)) !=
                        0);
        assert_int_equal(flow_stages[i].outputs & FLOW_SOURCES, 0);
        assert_true(flow_stages[i].outputs != 0);
        given |= flow_stages[i].outputs;
    }
    assert_true(given == FLOW_BIT(FLOW_N_RESOURCES) - 1);
}

/* Each source states what is missing without it. A table has the name of its schema and can be
 * requested by it. */
static void test_table_of_resources(void **state)
{
    (void)state;
    for (unsigned i = 0; i < FLOW_N_RESOURCES; i++) {
        const flow_resource_row *thing = &flow_resource_rows[i];
        char name[SCHEMA_NAME_SIZE];
        flow_resource_set things = 0;
        assert_non_null(thing->label);
        assert_int_equal(thing->missing != NULL, i < FLOW_FIRST_TABLE);
        if (thing->schema == NULL)
            continue;
        schema_name(thing->schema->name, thing->suffix, name);
        assert_string_equal(thing->label, name);
        assert_true(flow_table_resources(name, &things) && things == FLOW_BIT(i));
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_stages_that_run), cmocka_unit_test(test_requested_stages),
        cmocka_unit_test(test_reasons),         cmocka_unit_test(test_titles),
        cmocka_unit_test(test_table_of_stages), cmocka_unit_test(test_table_of_resources),
        cmocka_unit_test(test_records),
    };
    return cmocka_run_group_tests_name("flow plan", tests, NULL, NULL);
}
