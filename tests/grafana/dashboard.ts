// A dashboard as JSON has it: Grafana's types, with the values of its enums in place of their names, and with the options of each
// kind of panel that we use.
import type { AnnotationQuery, Dashboard, FieldConfigSource, Panel, RowPanel } from "@grafana/schema";
import type * as StateTimeline from "@grafana/schema/dist/esm/raw/composable/statetimeline/panelcfg/x/StateTimelinePanelCfg_types.gen";
import type * as Stat from "@grafana/schema/dist/esm/raw/composable/stat/panelcfg/x/StatPanelCfg_types.gen";
import type * as Table from "@grafana/schema/dist/esm/raw/composable/table/panelcfg/x/TablePanelCfg_types.gen";
import type * as TimeSeries from "@grafana/schema/dist/esm/raw/composable/timeseries/panelcfg/x/TimeSeriesPanelCfg_types.gen";

/** Text and numbers of enums. */
type Json<T> = T extends string
  ? `${T}`
  : T extends (infer Item)[]
    ? Json<Item>[]
    : T extends object
      ? { [Key in keyof T]: Json<T[Key]> }
      : T;

interface Query {
  refId: string;
  datasource: { type: "prometheus"; uid: string };
  expr: string;
  legendFormat: string;
  editorMode: "code";
  instant?: boolean;
  range?: boolean;
  format?: "table" | "time_series";
}

/** A kind of panel. `Custom`: what its fields may have set besides; all of it may be left out. */
type Of<Kind extends string, Options, Custom> = Json<Omit<Panel, "type" | "options" | "fieldConfig" | "targets">> & {
  type: Kind;
  title: string;
  targets: Query[];
  options: Json<Options>;
  fieldConfig: {
    defaults: Omit<Json<FieldConfigSource["defaults"]>, "custom"> & { custom?: Json<Partial<Custom>> };
    overrides: Json<FieldConfigSource["overrides"]>;
  };
};

type OurPanel =
  | Json<RowPanel>
  | Of<"stat", Stat.Options, Record<string, never>>
  | Of<"timeseries", TimeSeries.Options, TimeSeries.FieldConfig>
  | Of<"state-timeline", StateTimeline.Options, StateTimeline.FieldConfig>
  | Of<"table", Table.Options, Table.FieldConfig>;

type Annotation = Json<AnnotationQuery> & { expr: string; titleFormat: string };

export type OurDashboard = Omit<Json<Dashboard>, "panels" | "annotations"> & {
  uid: string;
  panels: OurPanel[];
  annotations: { list: Annotation[] };
};
