-- What the test in neovim.rs does in the editor; every step is reported or changes a file.

local report = {}

local function quit(code)
  vim.fn.writefile(report, "report.txt")
  vim.cmd(code == 0 and "wall!" or "echo")
  vim.cmd((code == 0 and "0" or "1") .. "cquit")
end

local function check(condition, message)
  if not condition then
    table.insert(report, "failed: " .. message)
    quit(1)
  end
end

local function run()
  local id = vim.lsp.start_client({ name = "inpact", cmd = { vim.env.INPACT, "server" }, root_dir = vim.fn.getcwd() })
  check(id, "the server starts")
  local buffer = vim.api.nvim_get_current_buf()
  check(vim.lsp.buf_attach_client(buffer, id), "the buffer attaches")

  local function findings()
    return vim.diagnostic.get(buffer)
  end
  check(vim.wait(60000, function() return #findings() > 0 end, 20), "findings come")
  for _, found in ipairs(findings()) do
    local code = found.user_data and found.user_data.lsp and found.user_data.lsp.code or found.code
    local message = vim.split(found.message, "\n")[1]
    table.insert(report, string.format("%d:%d %s %s", found.lnum + 1, found.col, code, message))
  end

  local document = { uri = vim.uri_from_bufnr(buffer) }
  local function ask(method, params)
    local answers, err = vim.lsp.buf_request_sync(buffer, method, params, 60000)
    check(answers and answers[id] and not answers[id].error, method .. ": " .. vim.inspect(err or answers))
    return answers[id].result
  end
  local encoding = vim.lsp.get_client_by_id(id).offset_encoding

  -- The fix of the first finding.
  local range = { start = { line = 1, character = 0 }, ["end"] = { line = 1, character = 5 } }
  local actions = ask("textDocument/codeAction", { textDocument = document, range = range, context = { diagnostics = {} } })
  vim.lsp.util.apply_workspace_edit(actions[1].edit, encoding)
  check(vim.wait(60000, function() return #findings() == 0 end, 20), "the finding goes away")
  table.insert(report, string.format("after the fix: %d findings", #findings()))

  -- Another name, in both files.
  local position = { line = 0, character = 28 }
  local edit = ask("textDocument/rename", { textDocument = document, position = position, newName = "CONTACT-1" })
  local symbols = ask("textDocument/documentSymbol", { textDocument = document })
  local names = {}
  for _, symbol in ipairs(symbols) do
    table.insert(names, symbol.name)
  end
  table.insert(report, "symbols: " .. table.concat(names, ", "))
  vim.lsp.util.apply_workspace_edit(edit, encoding)

  local layout = { tabSize = 4, insertSpaces = true }
  local edits = ask("textDocument/formatting", { textDocument = document, options = layout })
  vim.lsp.util.apply_text_edits(edits, buffer, encoding)
  quit(0)
end

local ok, message = pcall(run)
if not ok then
  table.insert(report, "failed: " .. tostring(message))
  quit(1)
end
