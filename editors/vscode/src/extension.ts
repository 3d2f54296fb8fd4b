// Starts `inpact server` for decks, and has the commands that the protocol has no name for.

import { execFile } from "node:child_process";
import { mkdtemp, readFile, rm } from "node:fs/promises";
import { tmpdir } from "node:os";
import { basename, dirname, join } from "node:path";
import { promisify } from "node:util";
import * as vscode from "vscode";
import { LanguageClient, State } from "vscode-languageclient/node";

const LANGUAGE = "abaqus-inp";
// The most bytes that a command may print.
const LONGEST_OUTPUT = 256 * 1024 * 1024;

/** What the server says of a table at its lens: what to draw, and its first and last line. */
interface Drawing {
  interaction: string;
  law: string;
  lines: [number, number];
}

let client: LanguageClient | undefined;
const output = vscode.window.createOutputChannel("inpact: evaluation");

export async function activate(context: vscode.ExtensionContext): Promise<void> {
  context.subscriptions.push(
    output,
    vscode.commands.registerCommand("inpact.restart", restart),
    vscode.commands.registerCommand("inpact.showCurves", showCurves),
    vscode.commands.registerCommand("inpact.showAllCurves", showAllCurves),
    vscode.commands.registerCommand("inpact.evaluateOn", evaluateOn),
    vscode.workspace.onDidChangeConfiguration(async (event) => {
      if (event.affectsConfiguration("inpact.path")) {
        await restart();
      }
    }),
  );
  await start();
}

export async function deactivate(): Promise<void> {
  await client?.stop();
}

function program(): string {
  return vscode.workspace.getConfiguration("inpact").get<string>("path") || "inpact";
}

/** The settings that the server knows; what is empty is left to `inpact.toml`. */
function settings(): Record<string, unknown> {
  const all = vscode.workspace.getConfiguration("inpact");
  const names = ["dialect", "release", "includeDirs", "includeRoot", "relativeTo", "config", "isolated"];
  const given = names.map((name) => [name, all.get(name)] as const);
  return Object.fromEntries(given.filter(([, value]) => value !== null && value !== undefined && value !== ""));
}

async function start(): Promise<void> {
  const server = { command: program(), args: ["server"] };
  const created = new LanguageClient("inpact", "inpact", server, {
    documentSelector: [{ language: LANGUAGE }],
    initializationOptions: settings(),
    middleware: {
      // The lens above a table opens its curves; the server leaves the command to the editor.
      provideCodeLenses: async (document, token, next) => {
        const lenses = await next(document, token);
        for (const lens of lenses ?? []) {
          const drawing = drawingOf(lens);
          if (drawing !== undefined && lens.command !== undefined) {
            lens.command = { ...lens.command, command: "inpact.showCurves", tooltip: "Show the curves", arguments: [drawing] };
          }
        }
        return lenses;
      },
      workspace: {
        didChangeConfiguration: async () => {
          await created.sendNotification("workspace/didChangeConfiguration", { settings: { inpact: settings() } });
        },
      },
    },
    synchronize: { configurationSection: "inpact" },
  });
  client = created;
  try {
    await created.start();
  } catch (error) {
    const choice = await vscode.window.showErrorMessage(
      `\`${program()}\` cannot be started: ${String(error)}. Install inpact, or name it in the setting \`inpact.path\`.`,
      "Open the setting",
    );
    if (choice !== undefined) {
      await vscode.commands.executeCommand("workbench.action.openSettings", "inpact.path");
    }
  }
}

async function restart(): Promise<void> {
  if (client?.state === State.Running) {
    await client.stop();
  }
  await start();
}

/** The deck that is being edited, saved: what other commands read is on disk. */
async function savedDeck(): Promise<vscode.TextDocument | undefined> {
  const document = vscode.window.activeTextEditor?.document;
  if (document?.languageId !== LANGUAGE) {
    await vscode.window.showInformationMessage("inpact: open a deck first");
    return undefined;
  }
  if ((document.isDirty || document.isUntitled) && !(await document.save())) {
    return undefined;
  }
  return document.uri.scheme === "file" ? document : undefined;
}

function drawingOf(lens: vscode.CodeLens): Drawing | undefined {
  return lens.command?.arguments?.[0] as Drawing | undefined;
}

/** The table that the cursor is in. */
async function tableAtCursor(deck: vscode.TextDocument): Promise<Drawing | undefined> {
  const line = vscode.window.activeTextEditor?.selection.active.line ?? 0;
  const lenses = await vscode.commands.executeCommand<vscode.CodeLens[]>("vscode.executeCodeLensProvider", deck.uri);
  const drawings = (lenses ?? []).map(drawingOf).filter((drawing) => drawing !== undefined);
  return drawings.find(({ lines }) => lines[0] <= line && line <= lines[1]);
}

/** Draws one table, given by its lens or by the cursor; the whole deck where there is none. */
async function showCurves(given?: Drawing): Promise<void> {
  const deck = await savedDeck();
  if (deck === undefined) {
    return;
  }
  const table = typeof given?.law === "string" ? given : await tableAtCursor(deck);
  await draw(deck, table);
}

async function showAllCurves(): Promise<void> {
  const deck = await savedDeck();
  if (deck !== undefined) {
    await draw(deck, undefined);
  }
}

async function draw(deck: vscode.TextDocument, table: Drawing | undefined): Promise<void> {
  const path = deck.uri.fsPath;
  const folder = await mkdtemp(join(tmpdir(), "inpact-"));
  try {
    const picture = join(folder, "curves.svg");
    const part = table === undefined ? [] : [`--interaction=${table.interaction}`, "--law", table.law];
    await run(["plot", path, "--findings", ...part, "-o", picture], dirname(path));
    const title = table === undefined ? `Curves of ${basename(path)}` : `${table.interaction}: ${table.law}`;
    const panel = vscode.window.createWebviewPanel("inpact.curves", title, vscode.ViewColumn.Beside, {});
    // A picture has no scripts, and none are allowed.
    const policy = "default-src 'none'; img-src data:; style-src 'unsafe-inline'";
    const encoded = (await readFile(picture)).toString("base64");
    panel.webview.html = `<!DOCTYPE html><html><head><meta http-equiv="Content-Security-Policy" content="${policy}"></head>
      <body style="background: white"><img style="max-width: 100%" src="data:image/svg+xml;base64,${encoded}"></body></html>`;
  } catch (error) {
    await complain(error);
  } finally {
    await rm(folder, { recursive: true, force: true });
  }
}

/** Runs the program; as a process of its own, not as a line for a shell: names of files may hold anything. */
async function run(args: string[], cwd: string): Promise<{ stdout: string; stderr: string }> {
  return promisify(execFile)(program(), args, { cwd, maxBuffer: LONGEST_OUTPUT });
}

async function complain(error: unknown): Promise<void> {
  const said = (error as { stderr?: string }).stderr?.trim();
  await vscode.window.showErrorMessage(`inpact: ${said || String(error)}`);
}

async function evaluateOn(): Promise<void> {
  const deck = await savedDeck();
  if (deck === undefined) {
    return;
  }
  const chosen = await vscode.window.showOpenDialog({
    defaultUri: vscode.Uri.file(dirname(deck.uri.fsPath)),
    canSelectMany: false,
    openLabel: "Evaluate on",
    filters: { "Node tables": ["csv", "parquet", "arrow"] },
  });
  const table = chosen?.[0];
  if (table === undefined) {
    return;
  }
  try {
    const { stdout, stderr } = await run(["eval", deck.uri.fsPath, "--nodes", table.fsPath], dirname(deck.uri.fsPath));
    output.appendLine(stderr);
    output.show(true);
    const results = await vscode.workspace.openTextDocument({ content: stdout, language: "csv" });
    await vscode.window.showTextDocument(results, vscode.ViewColumn.Beside);
  } catch (error) {
    await complain(error);
  }
}
