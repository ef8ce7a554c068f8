/** The operator's page: puts its parts together. */
import { Actions } from './act/actions.js';
import { Stop } from './act/stop.js';
import { Drawers } from './drawers/drawers.js';
import { DrivePanel } from './drive/panel.js';
import { Timeline } from './look_back/timeline.js';
import { Screen } from './live/screen.js';
import { OperatorMap } from './map/operator_map.js';
import { Bar } from './robots/bar.js';
import { Chosen } from './robots/chosen.js';
import { RobotList } from './robots/list.js';
import { byId } from './words/element.js';
import { writePhrases } from './words/phrases.js';

writePhrases();
const screen = new Screen('/live');
const actions = new Actions(screen, byId('outcomes'));
const map = new OperatorMap(screen, actions);
const drive = new DrivePanel(screen, map, actions);
screen.add(new Bar());
screen.add(new Stop(screen, actions, byId('stop')));
screen.add(new RobotList(byId('robots')));
screen.add(new Chosen(actions, byId('chosen'), {
  drive: () => {
    drawers.close();
    drive.show();
  },
  place: () => map.begin('pose'),
}));
screen.add(map);
screen.add(drive);
screen.add(new Timeline(screen, actions, byId('look-back')));
const drawers = new Drawers(screen, actions, map, () => drive.hide());
screen.add(drawers);
screen.redraw();
